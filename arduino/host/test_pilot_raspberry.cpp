#include <doctest/doctest.h>

#include "pilot_bench.h"

using namespace raspilot;

TEST_CASE("pilot Raspberry Pi: an Output is followed for 250 ms, then FBW holds level") {
  FlyingBench bench(2000);
  REQUIRE(bench.output(1723, 0) == Reason::NONE);
  bench.run(2);
  CHECK(bench.authority.mode() == Mode::OUTPUT);
  CHECK(bench.authority.flown_mode() == Mode::OUTPUT);
  CHECK(bench.authority.asked().outputs.ticks[AILERONS] == us_to_ticks(1723));
  bench.run(240);
  CHECK(bench.authority.flown_mode() == Mode::OUTPUT);
  bench.run(8);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.authority.mode() == Mode::FBW);
}

TEST_CASE("pilot Raspberry Pi: an Output of an orientation older than 100 ms is refused") {
  FlyingBench bench(2000);
  CHECK(bench.output(1600, 0, 100001) == Reason::TOO_OLD);
  CHECK(bench.output(1600, 0, 0xFFFFFFFF) == Reason::TOO_OLD);
  bench.run(2);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.output(1600, 0, 100000) == Reason::NONE);
}

TEST_CASE("pilot Raspberry Pi: its authority needs AUTO, receiver, IMU, and a motor armed") {
  FlyingBench bench(2000);
  Reason reason = Reason::NONE;
  SUBCASE("all is well") {}
  SUBCASE("switch") {
    bench.sticks[AUX1] = 1500;
    reason = Reason::NOT_AT_AUTO;
  }
  SUBCASE("receiver") {
    bench.sticks[ELEVATOR] = 2200;
    reason = Reason::RECEIVER_INVALID;
  }
  SUBCASE("IMU") {
    bench.is_imu_valid = false;
    reason = Reason::IMU_INVALID;
  }
  SUBCASE("disarmed") {
    bench.run(2000);
    REQUIRE(bench.disarm() == Reason::NONE);
    reason = Reason::VETO;
  }
  bench.run(40);
  CHECK(bench.output(1600, 1700) == reason);
  bench.run(2);
  CHECK((bench.authority.flown_mode() == Mode::OUTPUT) == (reason == Reason::NONE));
  bench.run(300);
  CHECK(bench.demand(1000, 1700) == reason);
  bench.run(2);
  CHECK((bench.authority.flown_mode() == Mode::SETPOINT) == (reason == Reason::NONE));
  CHECK(bench.throttle_us() == (reason == Reason::NONE ? 1700 : 1000));
}

TEST_CASE("pilot Raspberry Pi: an IMU that is lost ends an Output that lives") {
  FlyingBench bench(2000);
  bench.move(THROTTLE, 1300, 60);
  REQUIRE(bench.output(1600, 1700) == Reason::NONE);
  bench.is_imu_valid = false;
  bench.run(2);
  CHECK(bench.authority.mode() == Mode::ACRO);
  CHECK(bench.throttle_us() == 1300);
  CHECK(bench.ask('u') == Reason::IMU_INVALID);
}

TEST_CASE("pilot Raspberry Pi: a Setpoint lives as long as it says, 1 to 250 ms") {
  FlyingBench bench(2000);
  for (uint16_t lifetime_ms : {uint16_t{250}, uint16_t{100}, uint16_t{20}}) {
    REQUIRE(bench.demand(-1234, 0, lifetime_ms) == Reason::NONE);
    bench.run(2);
    CHECK(bench.authority.mode() == Mode::SETPOINT);
    CHECK(bench.authority.asked().setpoint.roll_cdeg == -1234);
    bench.run(lifetime_ms - 6u);
    CHECK(bench.authority.flown_mode() == Mode::SETPOINT);
    bench.run(4);
    CHECK(bench.authority.flown_mode() == Mode::FBW);
  }
}

TEST_CASE("pilot Raspberry Pi: no Setpoint lives longer than 250 ms, nor one of no lifetime") {
  FlyingBench bench(2000);
  REQUIRE(bench.demand(-1234, 0, 65535) == Reason::NONE);
  bench.run(250);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  REQUIRE(bench.demand(-1234, 0, 0) == Reason::NONE);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
}

TEST_CASE("pilot Raspberry Pi: the throttle is the stick's unless a living demand names one") {
  FlyingBench bench(2000);
  bench.move(THROTTLE, 1300, 60);
  CHECK(bench.output(1500, 0) == Reason::NONE);
  CHECK(bench.throttle_us() == 1300);
  CHECK(bench.output(1500, 1777) == Reason::NONE);
  CHECK(bench.throttle_us() == 1777);
  bench.run(252);
  CHECK(bench.throttle_us() == 1300);
  CHECK(bench.demand(0, 1444, 50) == Reason::NONE);
  CHECK(bench.throttle_us() == 1444);
  bench.run(52);
  CHECK(bench.throttle_us() == 1300);
  CHECK(bench.demand(0, 0, 50) == Reason::NONE);
  CHECK(bench.throttle_us() == 1300);
}

TEST_CASE("pilot Raspberry Pi: another mode from the ground ends Outputs until it requests them") {
  FlyingBench bench(2000);
  REQUIRE(bench.output(1600, 1700) == Reason::NONE);
  REQUIRE(bench.ask('f') == Reason::NONE);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.throttle_us() == 1000);
  CHECK(bench.output(1600, 1700) == Reason::NOT_AT_AUTO);
  CHECK(bench.demand(1600, 1700) == Reason::NOT_AT_AUTO);
  REQUIRE(bench.ask('s') == Reason::NONE);
  CHECK(bench.output(1600, 1700) == Reason::NOT_AT_AUTO);
  CHECK(bench.demand(1600, 1700) == Reason::NONE);
  REQUIRE(bench.ask('u') == Reason::NONE);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.demand(1600, 1700) == Reason::NOT_AT_AUTO);
  CHECK(bench.output(1600, 1700) == Reason::NONE);
  CHECK(bench.authority.flown_mode() == Mode::OUTPUT);
}

TEST_CASE("pilot Raspberry Pi: a requested OUTPUT is reported for 500 ms while FBW is active") {
  FlyingBench bench(2000);
  REQUIRE(bench.ask('u') == Reason::NONE);
  for (int slot = 0; slot < 248; ++slot) {
    CHECK(bench.authority.mode() == Mode::OUTPUT);
    CHECK(bench.authority.flown_mode() == Mode::FBW);
    CHECK(bench.throttle_us() == 1000);
    bench.run(2);
  }
  bench.run(6);
  CHECK(bench.authority.mode() == Mode::FBW);
  CHECK(bench.output(1600, 0) == Reason::NONE);
  CHECK(bench.authority.mode() == Mode::OUTPUT);
}

TEST_CASE("pilot Raspberry Pi: of Output and Setpoint the newer counts") {
  FlyingBench bench(2000);
  REQUIRE(bench.output(1600, 1700) == Reason::NONE);
  REQUIRE(bench.demand(0, 1200) == Reason::NONE);
  CHECK(bench.authority.flown_mode() == Mode::SETPOINT);
  CHECK(bench.throttle_us() == 1200);
  REQUIRE(bench.output(1600, 1700) == Reason::NONE);
  CHECK(bench.authority.flown_mode() == Mode::OUTPUT);
  CHECK(bench.throttle_us() == 1700);
  REQUIRE(bench.ask('s') == Reason::NONE);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
  CHECK(bench.throttle_us() == 1000);
}

TEST_CASE("pilot Raspberry Pi: OUTPUT is not reported when it cannot be active") {
  FlyingBench bench(2000);
  REQUIRE(bench.ask('u') == Reason::NONE);
  bench.run(20);
  SUBCASE("without an IMU") {
    bench.is_imu_valid = false;
    bench.run(2);
    CHECK(bench.authority.mode() == Mode::ACRO);
  }
  SUBCASE("without a receiver") {
    bench.move(THROTTLE, 890, 60);
    CHECK(bench.authority.mode() == Mode::FBW);
  }
}
