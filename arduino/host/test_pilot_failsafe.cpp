#include <doctest/doctest.h>

#include "pilot_bench.h"

using namespace raspilot;

namespace {

/** Armed, stick at 1600 us, failsafe throttle 1250 us. */
struct FailsafeBench : PilotBench {
  explicit FailsafeBench(uint16_t aux1_us) {
    profile.throttle_failsafe_us = 1250;
    fly(aux1_us);
    REQUIRE(authority.is_armed());
    sticks[THROTTLE] = 1600;
    move(AILERONS, 1700, 200);
  }
};

}  // namespace

TEST_CASE("pilot failsafe: a lost receiver acts between 500 ms and a second, sticks hold before") {
  for (uint16_t aux1 : {uint16_t{1000}, uint16_t{1500}, uint16_t{2000}}) {
    FailsafeBench bench(aux1);
    const Mode before = bench.authority.flown_mode();
    bench.is_on = false;
    bench.run(500);
    CHECK_FALSE(bench.authority.has_receiver());
    CHECK_FALSE(bench.authority.is_failsafe());
    CHECK(bench.authority.flown_mode() == before);
    CHECK(bench.throttle_us() == 1600);
    CHECK(bench.reader.pulse(AILERONS) == us_to_ticks(1700));
    const auto acts = [&] { return bench.authority.is_failsafe(); };
    CHECK(bench.run_until(acts, 1000) <= 150);
    CHECK(bench.authority.mode() == Mode::FBW);
    CHECK(bench.throttle_us() == 1250);
    CHECK(bench.authority.is_armed());
  }
}

TEST_CASE("pilot failsafe: loss is seen within 100 ms") {
  FailsafeBench bench(1500);
  bench.is_on = false;
  const auto is_seen = [&] { return !bench.authority.has_receiver(); };
  CHECK(bench.run_until(is_seen, 1000) <= 110);
}

TEST_CASE("pilot failsafe: one channel that is dead or out of range is a lost receiver") {
  FailsafeBench bench(1500);
  bench.move(ELEVATOR, 2200, 60);
  CHECK_FALSE(bench.authority.has_receiver());
  CHECK_FALSE(bench.authority.is_failsafe());
  bench.run(600);
  CHECK(bench.authority.is_failsafe());
}

TEST_CASE("pilot failsafe: a receiver in its own failsafe triggers failsafe immediately") {
  FailsafeBench bench(1500);
  bench.sticks[THROTTLE] = 890;
  const auto acts = [&] { return bench.authority.is_failsafe(); };
  CHECK(bench.run_until(acts, 100) <= 30);
  CHECK(bench.throttle_us() == 1250);
  CHECK(bench.authority.mode() == Mode::FBW);
}

TEST_CASE("pilot failsafe: the threshold of the receiver's own failsafe is the profile's") {
  FailsafeBench bench(1500);
  bench.profile.throttle_lost_us = 960;
  bench.move(THROTTLE, 962, 100);
  CHECK(bench.authority.has_receiver());
  bench.move(THROTTLE, 940, 100);
  CHECK(bench.authority.is_failsafe());
}

TEST_CASE("pilot failsafe: the return gives the mode of the switch as it stands") {
  FailsafeBench bench(1500);
  bench.is_on = false;
  bench.run(3000);
  REQUIRE(bench.authority.is_failsafe());
  CHECK(bench.authority.switch_position() == 1);
  bench.sticks[AUX1] = 1000;
  bench.is_on = true;
  bench.run(60);
  CHECK_FALSE(bench.authority.is_failsafe());
  CHECK(bench.authority.mode() == Mode::ACRO);
  CHECK(bench.throttle_us() == 1600);
}

TEST_CASE("pilot failsafe: channels that the receiver moves in its failsafe do not switch") {
  FailsafeBench bench(2000);
  REQUIRE(bench.ask('r') == Reason::NONE);
  bench.sticks[THROTTLE] = 890;
  bench.sticks[AUX1] = bench.sticks[AUX2] = 1000;
  bench.run(3000);
  CHECK(bench.authority.switch_position() == 2);
  CHECK(bench.authority.is_auto());
  CHECK(bench.authority.mode() == Mode::FBW);
  bench.sticks[THROTTLE] = 1600;
  bench.sticks[AUX1] = bench.sticks[AUX2] = 2000;
  const auto is_back = [&] { return !bench.authority.is_failsafe(); };
  CHECK(bench.run_until(is_back, 200) <= 70);
  CHECK(bench.authority.mode() == Mode::RATE);
  CHECK(bench.authority.is_armed());
}

TEST_CASE("pilot failsafe: the Raspberry Pi is ignored, and its earlier requests end") {
  FailsafeBench bench(2000);
  REQUIRE(bench.output(1900, 1800) == Reason::NONE);
  bench.run(2);
  REQUIRE(bench.throttle_us() == 1800);
  bench.move(THROTTLE, 890, 40);
  REQUIRE(bench.authority.is_failsafe());
  CHECK(bench.throttle_us() == 1250);
  CHECK(bench.output(1900, 1800) == Reason::RECEIVER_INVALID);
  CHECK(bench.demand(1000, 1800) == Reason::RECEIVER_INVALID);
  CHECK(bench.ask('u') == Reason::RECEIVER_INVALID);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.authority.mode() == Mode::FBW);
  bench.move(THROTTLE, 1600, 40);
  REQUIRE_FALSE(bench.authority.is_failsafe());
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.throttle_us() == 1600);
}

TEST_CASE("pilot failsafe: an Output is not followed while the receiver is lost") {
  FailsafeBench bench(2000);
  bench.on_slot = [&] { bench.output(1900, 1800); };
  bench.run(100);
  REQUIRE(bench.authority.flown_mode() == Mode::OUTPUT);
  bench.move(ELEVATOR, 2200, 40);
  CHECK_FALSE(bench.authority.is_failsafe());
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.throttle_us() == 1600);
}

TEST_CASE("pilot failsafe: after more than 5 s the throttle waits for a low stick") {
  FailsafeBench bench(1500);
  bench.is_on = false;
  bench.run(5300);
  CHECK(bench.authority.state().is_throttle_latched);
  bench.is_on = true;
  bench.run(500);
  CHECK_FALSE(bench.authority.is_failsafe());
  CHECK(bench.throttle_us() == 1250);
  SUBCASE("not even an explicit demand at AUTO lifts it") {
    bench.move(AUX1, 2000, 60);
    CHECK(bench.output(1500, 1800) == Reason::NONE);
    CHECK(bench.throttle_us() == 1250);
    bench.run(300);
  }
  bench.move(THROTTLE, 1100, 60);
  CHECK(bench.throttle_us() == 1250);
  bench.move(THROTTLE, 1000, 60);
  CHECK_FALSE(bench.authority.state().is_throttle_latched);
  CHECK(bench.throttle_us() == 1000);
  bench.move(THROTTLE, 1500, 60);
  CHECK(bench.throttle_us() == 1500);
}

TEST_CASE("pilot failsafe: after less than 5 s the throttle returns to the stick immediately") {
  FailsafeBench bench(1500);
  bench.is_on = false;
  bench.run(4800);
  CHECK_FALSE(bench.authority.state().is_throttle_latched);
  bench.is_on = true;
  bench.run(60);
  CHECK(bench.throttle_us() == 1600);
}

TEST_CASE("pilot failsafe: its own failsafe latches the throttle too") {
  FailsafeBench bench(1500);
  bench.move(THROTTLE, 890, 5200);
  CHECK(bench.authority.state().is_throttle_latched);
  bench.move(THROTTLE, 1600, 100);
  CHECK(bench.throttle_us() == 1250);
}

TEST_CASE("pilot failsafe: without an IMU: preset surfaces, the same throttle") {
  FailsafeBench bench(1500);
  bench.is_on = bench.is_imu_valid = false;
  bench.run(1000);
  CHECK(bench.authority.is_failsafe());
  CHECK(bench.authority.flown_mode() == Mode::ACRO);
  CHECK(bench.throttle_us() == 1250);
}

TEST_CASE("pilot failsafe: disarmed, the motor gets 1000 us in failsafe too") {
  PilotBench bench;
  bench.profile.throttle_failsafe_us = 1250;
  bench.fly(1500, false);
  bench.is_on = false;
  bench.run(6000);
  CHECK(bench.authority.is_failsafe());
  CHECK(bench.throttle_us() == 1000);
}

TEST_CASE("pilot failsafe: before the first valid receiver no failsafe: level, without throttle") {
  for (bool has_motor : {true, false}) {
    PilotBench bench;
    bench.profile.has_motor = has_motor;
    bench.profile.throttle_failsafe_us = 1100;
    SUBCASE("nothing on the lines") { bench.is_on = false; }
    SUBCASE("its own failsafe since power-on") { bench.sticks[THROTTLE] = 890; }
    bench.run(10000);
    CHECK_FALSE(bench.authority.is_failsafe());
    CHECK_FALSE(bench.authority.is_armed());
    CHECK_FALSE(bench.authority.state().is_throttle_latched);
    CHECK(bench.authority.switch_position() == SWITCH_UNKNOWN);
    CHECK_FALSE(bench.authority.is_auto());
    CHECK(bench.authority.mode() == Mode::FBW);
    CHECK(bench.throttle_us() == (has_motor ? 1000 : 1100));
    CHECK(bench.ask('u') == Reason::NOT_AT_AUTO);
    bench.is_imu_valid = false;
    bench.run(2);
    CHECK(bench.authority.mode() == Mode::ACRO);
  }
}
