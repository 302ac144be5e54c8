#include <doctest/doctest.h>

#include <cstring>

#include "pilot_bench.h"

using namespace raspilot;

TEST_CASE("pilot switch: each position has its mode, AUTO without a demand is FBW") {
  const struct {
    const char* letters;
    Mode low, middle, high;
  } maps[] = {{"afA", Mode::ACRO, Mode::FBW, Mode::FBW},
              {"rAf", Mode::RATE, Mode::FBW, Mode::FBW},
              {"Aar", Mode::FBW, Mode::ACRO, Mode::RATE}};
  for (const auto& map : maps) {
    CAPTURE(map.letters);
    PilotBench bench;
    std::memcpy(bench.profile.switch_modes, map.letters, 3);
    for (uint8_t position = 0; position < 3; ++position) {
      bench.move(AUX1, static_cast<uint16_t>(1000 + 500 * position), 100);
      CHECK(bench.authority.switch_position() == position);
      CHECK(bench.authority.is_auto() == (map.letters[position] == 'A'));
      const Mode modes[] = {map.low, map.middle, map.high};
      CHECK(bench.authority.mode() == modes[position]);
      CHECK(bench.authority.flown_mode() == modes[position]);
    }
  }
}

TEST_CASE("pilot switch: 1300 and 1700 us part the positions, 20 us each way") {
  ModeSwitch aux1;
  CHECK(aux1.position() == SWITCH_UNKNOWN);
  const struct {
    int us;
    uint8_t position;
  } moves[] = {{1299, 0}, {1319, 0}, {1320, 1}, {1281, 1}, {1279, 0}, {1320, 1}, {1719, 1},
               {1720, 2}, {1681, 2}, {1679, 1}, {2000, 2}, {1000, 0}, {1500, 1}};
  for (const auto& move : moves) {
    CAPTURE(move.us);
    aux1.update(static_cast<Ticks>(2 * move.us));
    CHECK(aux1.position() == move.position);
  }
  ModeSwitch first;
  first.update(us_to_ticks(1300));
  CHECK(first.position() == 1);
}

TEST_CASE("pilot switch: leaving AUTO acts within one frame, whatever the Raspberry Pi sends") {
  for (uint16_t aux1 : {uint16_t{1000}, uint16_t{1500}}) {
    FlyingBench bench(2000);
    bench.on_slot = [&] { bench.output(1900, 1800); };
    bench.run(400);
    REQUIRE(bench.authority.flown_mode() == Mode::OUTPUT);
    REQUIRE(bench.throttle_us() == 1800);
    bench.sticks[AUX1] = aux1;
    const auto has_left = [&] { return bench.authority.flown_mode() != Mode::OUTPUT; };
    // A frame, the pulses before AUX1 in it, its own, and the slot.
    CHECK(bench.run_until(has_left, 100) <= 34);
    for (int slot = 0; slot < 300; ++slot) {
      CHECK(bench.authority.flown_mode() == (aux1 == 1000 ? Mode::ACRO : Mode::FBW));
      CHECK(bench.authority.mode() == bench.authority.flown_mode());
      CHECK(bench.throttle_us() == 1000);
      CHECK(bench.output(1900, 1800) == Reason::NOT_AT_AUTO);
      CHECK(bench.ask('u') == Reason::NOT_AT_AUTO);
      bench.run(2);
    }
  }
}

TEST_CASE("pilot switch: ground modes are taken at AUTO only, and never ACRO") {
  PilotBench bench;
  for (uint16_t aux1 : {uint16_t{1000}, uint16_t{1500}}) {
    bench.move(AUX1, aux1, 100);
    for (char letter : {'r', 'f', 's', 'u'}) CHECK(bench.ask(letter) == Reason::NOT_AT_AUTO);
    CHECK(bench.demand(1000, 0) == Reason::NOT_AT_AUTO);
    CHECK(bench.authority.mode() == (aux1 == 1000 ? Mode::ACRO : Mode::FBW));
  }
  bench.move(AUX1, 2000, 100);
  for (char letter : {'a', 'A', 'h', '\0', 'U', '\xFF'}) {
    CHECK(bench.ask(letter) == Reason::OUT_OF_RANGE);
    CHECK(bench.authority.mode() == Mode::FBW);
  }
  CHECK(bench.ask('r') == Reason::NONE);
  CHECK(bench.authority.mode() == Mode::RATE);
  CHECK(bench.ask('f') == Reason::NONE);
  CHECK(bench.authority.mode() == Mode::FBW);
  CHECK(bench.ask('s') == Reason::NONE);
  CHECK(bench.authority.mode() == Mode::FBW);
}

TEST_CASE("pilot switch: a bad pulse suspends AUTO and does not end the requested mode") {
  FlyingBench bench(2000);
  REQUIRE(bench.ask('r') == Reason::NONE);
  for (uint32_t left_ms : {2u, 40u, 140u}) {
    CAPTURE(left_ms);
    bench.sticks[AUX1] = 1500;
    REQUIRE(bench.run_until([&] { return !bench.authority.is_auto(); }, 100) <= 34);
    CHECK(bench.authority.mode() == Mode::FBW);
    CHECK(bench.output(1600, 0) == Reason::NOT_AT_AUTO);
    bench.run(left_ms - 2);
    bench.move(AUX1, 2000, 40);
    CHECK(bench.authority.mode() == (left_ms < 140 ? Mode::RATE : Mode::FBW));
  }
}

TEST_CASE("pilot switch: leaving AUTO ends the requests of ground and Raspberry Pi") {
  FlyingBench bench(2000);
  SUBCASE("the mode") {
    REQUIRE(bench.ask('r') == Reason::NONE);
    bench.move(AUX1, 1500, 140);
    bench.move(AUX1, 2000, 40);
    CHECK(bench.authority.mode() == Mode::FBW);
    CHECK(bench.output(1600, 0) == Reason::NONE);
  }
  SUBCASE("the Output") {
    REQUIRE(bench.output(1600, 1700) == Reason::NONE);
    bench.run(2);
    bench.move(AUX1, 1500, 40);
    bench.move(AUX1, 2000, 40);
    CHECK(bench.authority.flown_mode() == Mode::FBW);
    CHECK(bench.throttle_us() == 1000);
  }
  SUBCASE("the Setpoint") {
    REQUIRE(bench.demand(1600, 1700) == Reason::NONE);
    bench.run(2);
    bench.move(AUX1, 1000, 40);
    bench.move(AUX1, 2000, 40);
    CHECK(bench.authority.flown_mode() == Mode::FBW);
    CHECK(bench.throttle_us() == 1000);
  }
  SUBCASE("OUTPUT that was said before the first Output") {
    REQUIRE(bench.ask('u') == Reason::NONE);
    bench.move(AUX1, 1500, 40);
    bench.move(AUX1, 2000, 40);
    CHECK(bench.authority.mode() == Mode::FBW);
  }
}

TEST_CASE("pilot switch: without an IMU everything is a pass-through, and it comes back") {
  PilotBench bench;
  for (const char* letters : {"rfA", "ffA"}) {
    std::memcpy(bench.profile.switch_modes, letters, 3);
    for (uint16_t aux1 : {uint16_t{1000}, uint16_t{1500}, uint16_t{2000}}) {
      bench.fly(aux1);
      if (aux1 == 2000) REQUIRE(bench.ask('r') == Reason::NONE);
      const Mode before = bench.authority.mode();
      bench.is_imu_valid = false;
      bench.run(2);
      CHECK(bench.authority.mode() == Mode::ACRO);
      CHECK(bench.authority.flown_mode() == Mode::ACRO);
      CHECK(bench.authority.is_armed());
      bench.is_imu_valid = true;
      bench.run(2);
      CHECK(bench.authority.mode() == before);
    }
  }
}

TEST_CASE("pilot switch: outside AUTO Authority ignores a lost Raspberry Pi") {
  FlyingBench bench(1500);
  bench.sticks[THROTTLE] = 1600;
  bench.authority.accept_veto(true);
  bench.run(5000);
  CHECK(bench.authority.mode() == Mode::FBW);
  CHECK(bench.authority.is_armed());
  CHECK(bench.throttle_us() == 1600);
  CHECK_FALSE(bench.authority.is_failsafe());
}

TEST_CASE("pilot switch: a profile without AUTO ends an active Output immediately") {
  PilotBench bench;
  bench.profile.has_motor = false;
  bench.fly(2000, false);
  REQUIRE(bench.output(1600, 0) == Reason::NONE);
  REQUIRE(bench.authority.flown_mode() == Mode::OUTPUT);
  bench.profile.switch_modes[2] = 'f';
  CHECK(bench.authority.flown_mode() == Mode::FBW);
}
