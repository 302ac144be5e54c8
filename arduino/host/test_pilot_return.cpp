#include <doctest/doctest.h>

#include "pilot_bench.h"

using namespace raspilot;

namespace {

constexpr uint16_t AT_AUTO = 2000;
constexpr uint16_t AT_FBW = 1500;
constexpr uint16_t FAILSAFE_US = 1100;
constexpr uint16_t THROTTLE_US = 1600;
constexpr int16_t BANK_CDEG = 1500;

/** Armed at AUTO with the receiver lost; the Raspberry Pi may fly, with the motor. */
struct ReturnBench : PilotBench {
  explicit ReturnBench(uint8_t flags = PI_MAY_FLY | RETURN_WITH_MOTOR, bool is_armed = true,
                       uint16_t aux1_us = AT_AUTO) {
    profile.flags = flags;
    profile.throttle_failsafe_us = FAILSAFE_US;
    fly(aux1_us, is_armed);
    sticks[THROTTLE] = 1400;
    run(100);
    lose();
  }
  void lose() {
    is_on = false;
    run_until([this] { return authority.is_failsafe(); }, 1000);
  }
  /** Set-points every 50 ms. */
  void return_for(uint32_t ms, uint16_t throttle = THROTTLE_US) {
    for (uint32_t passed = 0; passed < ms; passed += 50) {
      return_by(BANK_CDEG, throttle);
      run(50);
    }
  }
  /** The receiver is found again on the way. */
  void return_and_find() {
    return_for(200);
    is_on = true;
  }
  Mode mode() const { return authority.flown_mode(); }
};

}  // namespace

TEST_CASE("pilot return: a set-point is followed in receiver failsafe, for its lifetime at most") {
  for (uint16_t lifetime_ms : {uint16_t{20}, uint16_t{250}}) {
    ReturnBench bench;
    CHECK(bench.mode() == Mode::FBW);
    CHECK(bench.return_by(BANK_CDEG, THROTTLE_US, lifetime_ms) == Reason::NONE);
    CHECK(bench.mode() == Mode::RETURN);
    CHECK(bench.authority.mode() == Mode::RETURN);
    CHECK(bench.authority.asked().setpoint.roll_cdeg == BANK_CDEG);
    CHECK(bench.throttle_us() == THROTTLE_US);
    bench.run(lifetime_ms - 12u);
    CHECK(bench.mode() == Mode::RETURN);
    bench.run(14);
    CHECK(bench.mode() == Mode::FBW);
    CHECK(bench.authority.is_failsafe());
    CHECK(bench.throttle_us() == FAILSAFE_US);
  }
}

TEST_CASE("pilot return: refused without the profile's bit") {
  ReturnBench bench(RETURN_WITH_MOTOR);
  CHECK(bench.return_by(BANK_CDEG, 0) == Reason::NOT_ALLOWED);
  CHECK(bench.mode() == Mode::FBW);
}

TEST_CASE("pilot return: refused while the receiver's failsafe does not act") {
  PilotBench bench;
  bench.profile.flags = PI_MAY_FLY | RETURN_WITH_MOTOR;
  CHECK(bench.return_by(0, 0) == Reason::NOT_IN_FAILSAFE);
  bench.fly(AT_AUTO);
  CHECK(bench.return_by(0, 0) == Reason::NOT_IN_FAILSAFE);
  bench.is_on = false;
  bench.run(300);
  CHECK(bench.return_by(0, 0) == Reason::NOT_IN_FAILSAFE);
  CHECK(bench.authority.flown_mode() == Mode::FBW);
}

TEST_CASE("pilot return: refused without an IMU, and an IMU that is lost ends it") {
  ReturnBench bench;
  bench.return_by(BANK_CDEG, THROTTLE_US);
  bench.is_imu_valid = false;
  bench.run(2);
  CHECK(bench.mode() == Mode::ACRO);
  CHECK(bench.throttle_us() == FAILSAFE_US);
  CHECK(bench.return_by(BANK_CDEG, THROTTLE_US) == Reason::IMU_INVALID);
}

TEST_CASE("pilot return: refused with a profile that cannot be read") {
  ReturnBench bench;
  bench.is_profile_broken = true;
  bench.run(2);
  CHECK(bench.return_by(BANK_CDEG, THROTTLE_US) == Reason::VETO);
}

TEST_CASE("pilot return: the motor follows only where the profile lets it") {
  ReturnBench bench(PI_MAY_FLY);
  CHECK(bench.return_by(BANK_CDEG, THROTTLE_US) == Reason::NONE);
  CHECK(bench.mode() == Mode::RETURN);
  CHECK(bench.throttle_us() == FAILSAFE_US);
}

TEST_CASE("pilot return: the motor stands while disarmed, and without a demand it is failsafe's") {
  ReturnBench disarmed(PI_MAY_FLY | RETURN_WITH_MOTOR, false);
  CHECK(disarmed.return_by(BANK_CDEG, THROTTLE_US) == Reason::NONE);
  CHECK(disarmed.mode() == Mode::RETURN);
  CHECK(disarmed.throttle_us() == 1000);
  ReturnBench armed;
  armed.return_by(BANK_CDEG, 0);
  CHECK(armed.throttle_us() == FAILSAFE_US);
}

TEST_CASE("pilot return: the motor runs on beyond 5 s, and stays off once it stood for 5 s") {
  ReturnBench bench;
  bench.return_for(12000);
  CHECK(bench.throttle_us() == THROTTLE_US);
  bench.run(3000);
  CHECK(bench.throttle_us() == FAILSAFE_US);
  bench.return_for(200);
  CHECK(bench.throttle_us() == THROTTLE_US);
  bench.run(5400);
  bench.return_for(200);
  CHECK(bench.mode() == Mode::RETURN);
  CHECK(bench.throttle_us() == FAILSAFE_US);
}

TEST_CASE("pilot return: a motor that was latched off before a reset stays off") {
  ReturnBench bench;
  bench.run(6000);
  PilotBench restored;
  restored.profile = bench.profile;
  restored.authority.restore(bench.authority.state(), restored.clock_us());
  restored.is_on = false;
  restored.run(10);
  CHECK(restored.return_by(BANK_CDEG, THROTTLE_US) == Reason::NONE);
  CHECK(restored.throttle_us() == FAILSAFE_US);
}

TEST_CASE("pilot return: the mere return of pulses gives the pilot nothing") {
  ReturnBench bench;
  bench.return_and_find();
  bench.return_for(5000);
  CHECK(bench.authority.has_receiver());
  CHECK(bench.authority.is_failsafe());
  CHECK(bench.mode() == Mode::RETURN);
  CHECK(bench.throttle_us() == THROTTLE_US);
}

TEST_CASE("pilot return: a stick that moves by a fifth of its travel after a second takes over") {
  for (uint8_t channel : {AILERONS, ELEVATOR, RUDDER, THROTTLE}) {
    CAPTURE(static_cast<int>(channel));
    ReturnBench bench;
    bench.return_for(200);
    bench.is_on = true;
    bench.return_for(1200);
    const uint16_t rest = bench.sticks[channel];
    bench.sticks[channel] = static_cast<uint16_t>(rest + 190);
    bench.return_for(300);
    CHECK(bench.mode() == Mode::RETURN);
    bench.sticks[channel] = static_cast<uint16_t>(rest + 210);
    bench.return_for(100);
    CHECK_FALSE(bench.authority.is_failsafe());
    CHECK(bench.mode() == Mode::FBW);
    CHECK(bench.return_by(BANK_CDEG, 0) == Reason::NOT_IN_FAILSAFE);
  }
}

TEST_CASE("pilot return: what moves within the first second of valid frames takes nothing over") {
  ReturnBench bench;
  bench.return_and_find();
  bench.return_for(500);
  bench.sticks[AILERONS] = 1900;
  bench.return_for(3000);
  CHECK(bench.mode() == Mode::RETURN);
  bench.sticks[AILERONS] = 1500;
  bench.return_for(100);
  CHECK(bench.mode() == Mode::FBW);
}

TEST_CASE("pilot return: a switch that is not at AUTO takes over after a second") {
  ReturnBench bench;
  bench.return_and_find();
  bench.return_for(1500);
  bench.sticks[AUX1] = AT_FBW;
  bench.return_for(100);
  CHECK_FALSE(bench.authority.is_failsafe());
  ReturnBench never_at_auto(PI_MAY_FLY, true, AT_FBW);
  never_at_auto.return_for(200);
  never_at_auto.is_on = true;
  never_at_auto.return_for(900);
  CHECK(never_at_auto.mode() == Mode::RETURN);
  never_at_auto.return_for(300);
  CHECK_FALSE(never_at_auto.authority.is_failsafe());
}

TEST_CASE("pilot return: set-points that stop give a receiver that is back to the pilot") {
  ReturnBench bench;
  bench.return_and_find();
  bench.return_for(300);
  bench.run(260);
  CHECK_FALSE(bench.authority.is_failsafe());
  CHECK(bench.mode() == Mode::FBW);
  CHECK(bench.throttle_us() == 1400);
}

TEST_CASE("pilot return: with the receiver back no Setpoint and no mode takes its place") {
  ReturnBench bench;
  bench.return_and_find();
  bench.return_for(300);
  CHECK(bench.demand(-2000, 1800) == Reason::RECEIVER_INVALID);
  CHECK(bench.output(1200, 1800) == Reason::RECEIVER_INVALID);
  CHECK(bench.ask('u') == Reason::RECEIVER_INVALID);
  CHECK(bench.authority.asked().setpoint.roll_cdeg == BANK_CDEG);
  CHECK(bench.authority.mode() == Mode::RETURN);
}
