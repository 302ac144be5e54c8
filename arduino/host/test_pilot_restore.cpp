#include <doctest/doctest.h>

#include <random>

#include "pilot_bench.h"

using namespace raspilot;

namespace {

/** The aircraft continues in another run of the board, with the sticks unchanged. */
void restart(PilotBench& bench, const PilotBench& before) {
  bench.profile = before.profile;
  std::copy(before.sticks, before.sticks + INPUTS, bench.sticks);
  bench.authority.restore(before.authority.state(), bench.clock_us());
}

}  // namespace

TEST_CASE("pilot restore: an armed aircraft flies on in its mode, with its throttle") {
  FlyingBench before(1500);
  before.move(THROTTLE, 1600, 100);
  PilotBench bench(123456789);
  restart(bench, before);
  CHECK(bench.authority.is_armed());
  CHECK(bench.authority.switch_position() == 1);
  CHECK(bench.authority.mode() == Mode::ACRO);
  bench.run(2);
  CHECK(bench.authority.mode() == Mode::FBW);
  bench.run(60);
  CHECK(bench.authority.is_armed());
  CHECK(bench.throttle_us() == 1600);
  CHECK(bench.authority.mode() == Mode::FBW);
}

TEST_CASE("pilot restore: the ground's requested mode, failsafe and latch are restored") {
  PilotBench before;
  before.profile.throttle_failsafe_us = 1250;
  before.fly(2000);
  REQUIRE(before.ask('r') == Reason::NONE);
  SUBCASE("the mode") {
    PilotBench bench;
    restart(bench, before);
    bench.run(60);
    CHECK(bench.authority.mode() == Mode::RATE);
  }
  SUBCASE("failsafe and its latch continue without a pause") {
    before.is_on = false;
    before.run(5500);
    REQUIRE(before.authority.is_failsafe());
    PilotBench bench;
    restart(bench, before);
    CHECK(bench.authority.is_failsafe());
    CHECK(bench.authority.state().is_throttle_latched);
    CHECK(bench.throttle_us() == 1250);
    bench.move(THROTTLE, 1600, 60);
    CHECK_FALSE(bench.authority.is_failsafe());
    CHECK(bench.throttle_us() == 1250);
  }
}

TEST_CASE("pilot restore: a receiver that stays lost triggers failsafe within a second") {
  FlyingBench before(1500);
  PilotBench bench;
  restart(bench, before);
  bench.is_on = false;
  bench.run(490);
  CHECK_FALSE(bench.authority.is_failsafe());
  bench.run(20);
  CHECK(bench.authority.is_failsafe());
  CHECK(bench.authority.is_armed());
}

TEST_CASE("pilot restore: a receiver that was never received does not count as lost") {
  PilotBench before;
  before.is_on = false;
  before.run(1000);
  PilotBench bench;
  restart(bench, before);
  bench.is_on = false;
  bench.run(3000);
  CHECK_FALSE(bench.authority.is_failsafe());
}

TEST_CASE("pilot restore: Outputs from before the reset do not live on") {
  FlyingBench before(2000);
  REQUIRE(before.output(1900, 1800) == Reason::NONE);
  PilotBench bench;
  restart(bench, before);
  bench.run(60);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.throttle_us() == 1000);
}

TEST_CASE("pilot restore: AUX2 keeps it armed and can still disarm it; it arms nothing") {
  FlyingBench before(1500);
  SUBCASE("armed") {
    PilotBench bench;
    restart(bench, before);
    bench.run(2000);
    CHECK(bench.authority.is_armed());
    bench.move(AUX2, 1000, 400);
    CHECK_FALSE(bench.authority.is_armed());
  }
  SUBCASE("disarmed") {
    before.run(2000);
    REQUIRE(before.disarm() == Reason::NONE);
    PilotBench bench;
    restart(bench, before);
    bench.run(3000);
    CHECK_FALSE(bench.authority.is_armed());
  }
}

TEST_CASE("pilot restore: without it nothing is armed") {
  PilotBench bench;
  CHECK_FALSE(bench.authority.is_armed());
  bench.move(AUX2, 2000, 3000);
  CHECK_FALSE(bench.authority.is_armed());
}

TEST_CASE("pilot: whatever happens, the rules hold") {
  const char* const maps[] = {"afA", "rAf", "AAA", "faA"};
  for (uint32_t seed = 0; seed < 24; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    PilotBench bench(static_cast<uint32_t>(random()));
    bench.profile.has_motor = seed % 4 != 3;
    std::copy(maps[seed % 4], maps[seed % 4] + 3, bench.profile.switch_modes);
    bench.profile.throttle_failsafe_us = 1111;
    bool was_armed = false;
    uint32_t aux2_low_ms = 0;
    const uint16_t places[] = {1000, 1000, 1500, 2000, 2000, 1040, 890, 2200, 1310};
    for (int step = 0; step < 600; ++step) {
      const uint32_t dice = static_cast<uint32_t>(random() % 24);
      if (dice < 8) bench.sticks[random() % INPUTS] = places[random() % 9];
      if (dice == 8) std::fill(bench.sticks, bench.sticks + INPUTS, uint16_t{1500});
      if (dice == 9) bench.is_on = !bench.is_on;
      if (dice == 10) bench.is_imu_valid = !bench.is_imu_valid;
      if (dice == 11) bench.is_calibrating = !bench.is_calibrating;
      if (dice == 12) bench.authority.accept_veto(random() & 1);
      if (dice == 13) bench.is_on = bench.is_imu_valid = !(bench.is_calibrating = false);
      if (dice == 14) bench.sticks[THROTTLE] = 1000;
      const uint8_t vetoes_before = bench.authority.vetoes();
      if (dice == 15 && bench.arm() == Reason::NONE) CHECK(vetoes_before == 0);
      if (dice == 16 && bench.disarm() == Reason::NONE) was_armed = false;
      if (dice >= 17 && dice <= 19) bench.output(1900, dice == 17 ? 0 : 1900);
      if (dice == 20) bench.demand(3000, 1800);
      if (dice >= 21) bench.ask("rfsu"[random() % 4]);
      was_armed = bench.authority.is_armed();
      for (uint32_t slot = static_cast<uint32_t>(random() % 60); slot-- > 0;) {
        bench.run(2);
        const Authority& authority = bench.authority;
        const Mode flown = authority.flown_mode();
        if (authority.is_armed() && !was_armed) REQUIRE(authority.vetoes() == 0);
        was_armed = authority.is_armed();
        if (bench.profile.has_motor && !was_armed) REQUIRE(bench.throttle_us() == 1000);
        if (authority.is_failsafe() && (was_armed || !bench.profile.has_motor)) {
          REQUIRE(bench.throttle_us() == 1111);
        }
        if (flown == Mode::OUTPUT || flown == Mode::SETPOINT) {
          REQUIRE(authority.is_auto());
          REQUIRE(authority.has_receiver());
          REQUIRE(bench.is_imu_valid);
          REQUIRE((was_armed || !bench.profile.has_motor));
        }
        if (!bench.is_imu_valid) REQUIRE(flown == Mode::ACRO);
        if (flown != Mode::OUTPUT && flown != Mode::SETPOINT && bench.throttle_us() != 1000) {
          const bool is_sticks = bench.throttle_us() == bench.reader.pulse(THROTTLE) / 2;
          REQUIRE((is_sticks || bench.throttle_us() == 1111));
        }
        aux2_low_ms = authority.has_receiver() && bench.reader.pulse(AUX2) < us_to_ticks(1400)
                          ? aux2_low_ms + 2
                          : 0;
        if (aux2_low_ms > 310) REQUIRE_FALSE(was_armed);
      }
    }
  }
}
