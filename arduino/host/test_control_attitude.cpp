#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "control/attitude_filter.h"
#include "moving_imu.h"

using namespace raspilot;

namespace {

/** The filter with an IMU that turns as the test says, slot by slot. */
struct Flight {
  Calibration calibration = DEFAULT_CALIBRATION;
  AttitudeFilter filter{calibration};
  MovingImu imu;
  uint32_t now_us = 0xFFFF0000;  // the clock wraps on the way

  void slot(double p = 0, double q = 0, double r = 0) {
    imu.turn(p, q, r);
    now_us += 2000;
    filter.on_sample(imu.sample(), now_us);
  }
  void slot_with_force(double p, double q, double r, const double* force_g) {
    imu.turn(p, q, r);
    now_us += 2000;
    filter.on_sample(imu.sample(force_g), now_us);
  }
  void fly(double seconds, double p = 0, double q = 0, double r = 0) {
    for (int slots = static_cast<int>(seconds * 500); slots > 0; --slots) slot(p, q, r);
  }
  void miss() {
    now_us += 2000;
    filter.on_missing(now_us);
  }
  void miss(double seconds) {
    for (int slots = static_cast<int>(seconds * 500); slots > 0; --slots) miss();
  }

  double roll_deg() const { return filter.attitude().roll_cdeg / 100.0; }
  double pitch_deg() const { return filter.attitude().pitch_cdeg / 100.0; }
  double bias_deg_s(int axis) const {
    return std::ldexp(filter.state().bias_q36[axis], -36) / 0.002 / DEG;
  }
  double yaw_deg() const { return filter.attitude().yaw_cdeg / 100.0; }
  /** Angle between what the filter and what the world takes for down. */
  double tilt_error_deg() const {
    const double roll = roll_deg() * DEG;
    const double pitch = pitch_deg() * DEG;
    const double down[3] = {-std::sin(pitch), std::sin(roll) * std::cos(pitch),
                            std::cos(roll) * std::cos(pitch)};
    double cosine = 0;
    for (int axis = 0; axis < 3; ++axis) cosine += down[axis] * imu.down[axis];
    return std::acos(std::fmin(1.0, cosine)) / DEG;
  }
};

/** A coordinated turn: what is felt stands on the floor, the more of it the steeper the bank. */
void turn(Flight& flight, double bank_deg, double speed_m_s, double seconds) {
  const double bank = bank_deg * DEG;
  const double rate_deg_s = GRAVITY_M_S2 * std::tan(bank) / speed_m_s / DEG;
  const double force[3] = {0, 0, -1 / std::cos(bank)};
  for (int slots = static_cast<int>(seconds * 500); slots > 0; --slots) {
    flight.slot_with_force(0, rate_deg_s * std::sin(bank), rate_deg_s * std::cos(bank), force);
  }
}

/** Rolls at 45 deg/s to a bank. */
void roll_to(Flight& flight, double bank_deg) {
  const double now_deg = flight.imu.roll_deg();
  const double seconds = std::fabs(bank_deg - now_deg) / 45;
  flight.fly(seconds, bank_deg > now_deg ? 45 : -45);
}

}  // namespace

TEST_CASE("attitude is there 200 ms after the first sample, whatever it is") {
  for (double roll : {0.0, 30.0, -75.0, 160.0}) {
    for (double pitch : {0.0, 20.0, -60.0}) {
      Flight flight;
      flight.imu.set(roll, pitch);
      CHECK_FALSE(flight.filter.is_valid());
      flight.fly(0.2);
      CHECK(flight.filter.is_valid());
      CHECK(flight.tilt_error_deg() <= 1.0);
    }
  }
}

TEST_CASE("axes have the signs of the air: right wing down, nose up, clockwise") {
  Flight flight;
  flight.fly(3);
  flight.fly(0.5, 40, 0, 0);
  CHECK(flight.roll_deg() == doctest::Approx(20).epsilon(0.01));
  CHECK(flight.filter.attitude().roll_rate_16 == doctest::Approx(640).epsilon(0.02));
  flight.fly(0.5, -40, 0, 0);
  flight.fly(0.5, 0, 30, 0);
  CHECK(flight.pitch_deg() == doctest::Approx(15).epsilon(0.02));
  CHECK(flight.filter.attitude().pitch_rate_16 == doctest::Approx(480).epsilon(0.02));
  flight.fly(0.5, 0, -30, 0);
  const double before_deg = flight.yaw_deg();
  flight.fly(1, 0, 0, 50);
  CHECK(flight.yaw_deg() - before_deg == doctest::Approx(50).epsilon(0.01));
  CHECK(flight.filter.attitude().yaw_rate_16 == doctest::Approx(800).epsilon(0.02));
}

TEST_CASE("two minutes at 30 degrees of bank leave at most 5 degrees of error") {
  for (double bias : {0.05, -0.05}) {
    for (double speed_m_s : {10.0, 15.0, 25.0}) {
      Flight flight;
      flight.fly(3);
      for (int axis = 0; axis < 3; ++axis) flight.imu.bias_deg_s[axis] = bias;
      roll_to(flight, 30);
      double greatest = 0;
      for (int second = 0; second < 120; ++second) {
        turn(flight, 30, speed_m_s, 1);
        greatest = std::fmax(greatest, flight.tilt_error_deg());
      }
      MESSAGE("bias " << bias << " deg/s, " << speed_m_s << " m/s: " << greatest << " deg");
      CHECK(greatest <= 5.0);
      roll_to(flight, 0);
      flight.fly(60);
      CHECK(flight.tilt_error_deg() <= 2.0);
    }
  }
}

TEST_CASE("a turn that feels like 1 g is told from level flight by its rate") {
  Flight flight;
  flight.fly(3);
  roll_to(flight, 20);
  turn(flight, 20, 15, 120);
  CHECK(flight.tilt_error_deg() <= 2.0);
}

TEST_CASE("a push that feels like more than 1 g tilts nothing") {
  Flight flight;
  flight.fly(4);
  // 0.6 g for 10 s: a launch by a bungee, or a dive.
  const double force[3] = {0.6, 0, -1};
  for (int slot = 0; slot < 5000; ++slot) flight.slot_with_force(0, 0, 0, force);
  CHECK(flight.tilt_error_deg() <= 1.0);
}

TEST_CASE("a long push along the nose tilts it little") {
  Flight flight;
  flight.fly(4);
  // 0.3 g for 3 s: a throttle opened.
  const double force[3] = {0.3, 0, -1};
  for (int slot = 0; slot < 1500; ++slot) flight.slot_with_force(0, 0, 0, force);
  CHECK(flight.tilt_error_deg() <= 4.0);
}

TEST_CASE("what the gyro reads too much in level flight is learned") {
  Flight flight;
  flight.fly(3);
  flight.imu.bias_deg_s[0] = 0.3;
  flight.imu.bias_deg_s[1] = -0.3;
  flight.fly(240);
  CHECK(flight.tilt_error_deg() <= 0.7);
  CHECK(std::abs(flight.filter.attitude().roll_rate_16) <= 4);
}

TEST_CASE("rolls and loops at full rates leave attitude right") {
  Flight flight;
  flight.imu.gyro_noise_deg_s = 0;
  flight.fly(3);
  flight.fly(3, 360, 0, 0);
  CHECK(flight.tilt_error_deg() <= 1.5);
  flight.fly(3, 0, 240, 0);
  CHECK(flight.tilt_error_deg() <= 2.5);
  flight.fly(2, -180, 90, 40);
  CHECK(flight.tilt_error_deg() <= 3.5);
}

TEST_CASE("the yaw of a minute's calm drifts by less than two degrees") {
  Flight flight;
  for (int axis = 0; axis < 3; ++axis) flight.imu.bias_deg_s[axis] = 1.7 - axis;
  flight.fly(3);
  const double before_deg = flight.yaw_deg();
  flight.fly(60);
  CHECK(std::fabs(flight.yaw_deg() - before_deg) <= 2.0);
}

TEST_CASE("yaw goes round the circle as heading, banked too") {
  Flight flight;
  flight.fly(3);
  roll_to(flight, 45);
  const double before_deg = flight.yaw_deg() - flight.imu.yaw_deg;
  turn(flight, 45, 15, 20);
  CHECK(std::fabs(std::remainder(flight.yaw_deg() - flight.imu.yaw_deg - before_deg, 360)) <= 3.0);
}

TEST_CASE("a still second gives the bias at start, and says so") {
  Flight flight;
  flight.imu.bias_deg_s[0] = 3.1;
  flight.imu.bias_deg_s[1] = -7.7;
  flight.imu.bias_deg_s[2] = 18.0;
  CHECK(flight.filter.is_calibrating());
  CHECK(flight.filter.is_bias_from_eeprom());
  flight.fly(1.1);
  CHECK_FALSE(flight.filter.is_calibrating());
  CHECK_FALSE(flight.filter.is_bias_from_eeprom());
  CHECK(flight.filter.is_still());
  CHECK(std::abs(flight.filter.attitude().roll_rate_16) <= 4);
  CHECK(std::abs(flight.filter.attitude().pitch_rate_16) <= 4);
  CHECK(std::abs(flight.filter.attitude().yaw_rate_16) <= 4);
  CHECK(flight.bias_deg_s(0) == doctest::Approx(3.1).epsilon(0.01));
  CHECK(flight.bias_deg_s(1) == doctest::Approx(-7.7).epsilon(0.01));
  CHECK(flight.bias_deg_s(2) == doctest::Approx(18.0).epsilon(0.01));
}

TEST_CASE("without stillness the bias of the calibration flies, and the search ends after 10 s") {
  Flight flight;
  flight.calibration.gyro_bias_16[0] = 32;
  flight.imu.bias_deg_s[0] = 2;
  for (int slot = 0; slot < 4990; ++slot) flight.slot(5 * std::sin(slot * 0.05), 0, 0);
  CHECK(flight.filter.is_calibrating());
  for (int slot = 0; slot < 20; ++slot) flight.slot(5 * std::sin(slot * 0.05), 0, 0);
  CHECK_FALSE(flight.filter.is_calibrating());
  CHECK(flight.filter.is_bias_from_eeprom());
  CHECK_FALSE(flight.filter.is_still());
  CHECK(flight.bias_deg_s(0) == doctest::Approx(2).epsilon(0.2));
  // Put down at last, still disarmed.
  flight.fly(1.2);
  CHECK_FALSE(flight.filter.is_bias_from_eeprom());
}

TEST_CASE("an armed aircraft never takes stillness for bias") {
  Flight flight;
  flight.filter.stop_calibrating();
  CHECK_FALSE(flight.filter.is_calibrating());
  flight.fly(3, 0, 0, 10);
  CHECK(flight.filter.is_bias_from_eeprom());
  CHECK(flight.bias_deg_s(2) == 0);
}

TEST_CASE("a turn that begins between two still seconds is no stillness") {
  Flight flight;
  flight.imu.gyro_noise_deg_s = 0.02;
  for (int slot = 0; slot < 512; ++slot) flight.slot();
  CHECK(flight.filter.is_still());
  flight.slot(0, 0, 15);
  CHECK_FALSE(flight.filter.is_still());
}

TEST_CASE("a copied, a silent or a broken IMU is invalid within 100 ms") {
  Flight flight;
  flight.fly(2);
  CHECK(flight.filter.is_valid());
  SUBCASE("the same sample again and again") {
    const ImuSample sample = flight.imu.sample();
    int slots = 0;
    for (; flight.filter.is_valid() && slots < 500; ++slots) {
      flight.now_us += 2000;
      flight.filter.on_sample(sample, flight.now_us);
    }
    CHECK(slots == 25);
    flight.miss(0.2);
    CHECK(flight.filter.age_ms(flight.now_us) >= 200);
  }
  SUBCASE("no sample") {
    int slots = 0;
    for (; flight.filter.is_valid() && slots < 500; ++slots) flight.miss();
    CHECK(slots == 25);
    CHECK(flight.filter.age_ms(flight.now_us) == 50);
  }
  SUBCASE("all zero, all ones, or a gyro at its end stop") {
    ImuSample broken = flight.imu.sample();
    for (int kind = 0; kind < 4; ++kind) {
      CAPTURE(kind);
      if (kind == 0) broken = {{0, 0, 0}, 0, {0, 0, 0}};
      if (kind == 1) broken = {{-1, -1, -1}, -1, {-1, -1, -1}};
      if (kind == 2) broken = {{10, 20, 4096}, 0, {1, 32767, 2}};
      if (kind == 3) broken = {{10, 20, 4096}, 0, {1, -32768, 2}};
      flight.fly(0.3);
      CHECK(flight.filter.is_valid());
      for (int slot = 0; slot < 26; ++slot) {
        flight.now_us += 2000;
        broken.accel[1] = static_cast<int16_t>(broken.accel[1] + (kind > 1 ? 1 : 0));
        flight.filter.on_sample(broken, flight.now_us);
      }
      CHECK_FALSE(flight.filter.is_valid());
    }
  }
  flight.fly(0.3);
  CHECK(flight.filter.is_valid());
  CHECK(flight.tilt_error_deg() <= 1.0);
}

TEST_CASE("one good sample among missing ones does not make the IMU valid") {
  Flight flight;
  flight.fly(2);
  flight.miss(0.1);
  for (int round = 0; round < 20; ++round) {
    flight.slot();
    CHECK_FALSE(flight.filter.is_valid());
    flight.miss(0.06);
  }
}

TEST_CASE("samples that were missed are made up for") {
  Flight flight;
  flight.fly(3);
  std::mt19937 random(3);
  for (int slot = 0; slot < 500; ++slot) {
    if (random() % 3 == 0) {
      flight.imu.turn(60, 0, 0);
      flight.miss();
    } else {
      flight.slot(60, 0, 0);
    }
  }
  flight.fly(0.1);
  CHECK(flight.tilt_error_deg() <= 1.0);
}

TEST_CASE("an IMU that was away for long finds gravity anew") {
  Flight flight;
  flight.fly(2);
  flight.miss(1.0);
  flight.imu.set(50, -10);
  flight.fly(0.1);
  CHECK_FALSE(flight.filter.is_valid());
  flight.fly(0.1);
  CHECK(flight.filter.is_valid());
  CHECK(flight.tilt_error_deg() <= 1.0);
}

TEST_CASE("the age of the newest sample stays at its greatest") {
  Flight flight;
  CHECK(flight.filter.age_ms(flight.now_us) == 65535);
  flight.slot();
  CHECK(flight.filter.age_ms(flight.now_us) == 0);
  flight.miss(1);
  CHECK(flight.filter.age_ms(flight.now_us) == 1000);
  flight.miss(200);
  CHECK(flight.filter.age_ms(flight.now_us) == 65535);
}

TEST_CASE("`e` 3 keeps the bias of a still second, and refuses without one") {
  Flight flight;
  CHECK(flight.filter.calibrate_gyro() == Reason::IMU_INVALID);
  flight.imu.bias_deg_s[1] = 4;
  flight.fly(0.5);
  CHECK(flight.filter.calibrate_gyro() == Reason::NOT_STILL);
  CHECK(flight.calibration.gyro_bias_16[1] == 0);
  flight.fly(1);
  CHECK(flight.filter.calibrate_gyro() == Reason::NONE);
  CHECK(std::abs(flight.calibration.gyro_bias_16[1] - 64) <= 1);
  // After the next start the calibration's bias is what flies until a still second.
  AttitudeFilter next(flight.calibration);
  next.stop_calibrating();
  uint32_t now_us = 0;
  for (int slot = 0; slot < 100; ++slot) next.on_sample(flight.imu.sample(), now_us += 2000);
  CHECK(std::abs(next.attitude().pitch_rate_16) <= 5);
}

TEST_CASE("`e` 0 makes this attitude level, in every attitude afterwards") {
  Flight flight;
  CHECK(flight.filter.calibrate_level() == Reason::IMU_INVALID);
  flight.imu.set(8, -5);
  flight.fly(0.5);
  CHECK(flight.filter.calibrate_level() == Reason::NOT_STILL);
  flight.fly(3);
  CHECK(flight.filter.calibrate_level() == Reason::NONE);
  CHECK(std::abs(flight.calibration.level_roll_cdeg - 800) <= 25);
  CHECK(std::abs(flight.calibration.level_pitch_cdeg + 500) <= 25);
  CHECK(std::fabs(flight.roll_deg()) <= 0.1);
  flight.fly(1);
  CHECK(std::fabs(flight.roll_deg()) <= 0.3);
  CHECK(std::fabs(flight.pitch_deg()) <= 0.3);
  // The airframe rolls about its own axis, the sensor about another.
  Level level;
  level.set(flight.calibration.level_roll_cdeg, flight.calibration.level_pitch_cdeg);
  int16_t axis[3] = {10000, 0, 0};
  level.tilt(axis);
  flight.fly(1, axis[0] * 0.006, axis[1] * 0.006, axis[2] * 0.006);
  CHECK(flight.roll_deg() == doctest::Approx(60).epsilon(0.01));
  CHECK(std::fabs(flight.pitch_deg()) <= 1.0);
  CHECK(flight.filter.attitude().roll_rate_16 == doctest::Approx(960).epsilon(0.02));
  CHECK(std::abs(flight.filter.attitude().pitch_rate_16) <= 10);
}

TEST_CASE("`e` 0 twice says the same again, and not beyond 15 degrees") {
  Flight flight;
  flight.imu.set(8, -5);
  flight.fly(4);
  CHECK(flight.filter.calibrate_level() == Reason::NONE);
  const Calibration first = flight.calibration;
  flight.fly(4);
  CHECK(flight.filter.calibrate_level() == Reason::NONE);
  CHECK(std::abs(flight.calibration.level_roll_cdeg - first.level_roll_cdeg) <= 25);
  CHECK(std::abs(flight.calibration.level_pitch_cdeg - first.level_pitch_cdeg) <= 25);
  Flight steep;
  steep.imu.set(0, 20);
  steep.fly(4);
  CHECK(steep.filter.calibrate_level() == Reason::OUT_OF_RANGE);
  CHECK(steep.calibration.level_pitch_cdeg == 0);
}

TEST_CASE("after a reset in flight attitude, yaw and bias are those from before at once") {
  Flight flight;
  flight.imu.bias_deg_s[0] = 2;
  flight.fly(3);
  roll_to(flight, 40);
  flight.fly(0.4, 0, 0, 30);
  const AttitudeState state = flight.filter.state();

  AttitudeFilter next(flight.calibration);
  uint32_t now_us = 5000;
  next.restore(state, now_us);
  CHECK_FALSE(next.is_valid());
  CHECK_FALSE(next.is_calibrating());
  CHECK(std::abs(next.attitude().roll_cdeg - flight.filter.attitude().roll_cdeg) <= 5);
  CHECK(std::abs(next.attitude().yaw_cdeg - flight.filter.attitude().yaw_cdeg) <= 5);
  flight.imu.turn(0, 0, 0);
  for (int slot = 0; slot < 15; ++slot) next.on_sample(flight.imu.sample(), now_us += 2000);
  CHECK(next.is_valid());
  CHECK(std::abs(next.attitude().roll_cdeg - flight.filter.attitude().roll_cdeg) <= 50);
  CHECK(std::abs(next.attitude().roll_rate_16) <= 5);
}

TEST_CASE("no input makes numbers overflow or the direction of gravity lose its length") {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> any(-32768, 32767);
  for (int round = 0; round < 40; ++round) {
    Calibration calibration = DEFAULT_CALIBRATION;
    calibration.level_roll_cdeg = static_cast<int16_t>(any(random) / 8);
    calibration.level_pitch_cdeg = static_cast<int16_t>(any(random) / 8);
    for (int16_t& bias : calibration.gyro_bias_16) bias = static_cast<int16_t>(any(random));
    AttitudeFilter filter(calibration);
    uint32_t now_us = static_cast<uint32_t>(random());
    const bool is_extreme = round % 2 != 0;
    for (int slot = 0; slot < 2000; ++slot) {
      now_us += 2000;
      ImuSample sample;
      for (int axis = 0; axis < 3; ++axis) {
        sample.accel[axis] = static_cast<int16_t>(is_extreme ? (random() % 2 ? 32767 : -32768)
                                                             : any(random));
        sample.gyro[axis] = static_cast<int16_t>(is_extreme ? (random() % 2 ? 32766 : -32766)
                                                            : any(random));
      }
      if (slot % 7 == 0) {
        for (int axis = 0; axis < 3; ++axis) sample.accel[axis] /= 8;
      }
      filter.on_sample(sample, now_us);
      if (random() % 16 == 0) filter.on_missing(now_us);
      if (random() % 512 == 0) filter.restore(filter.state(), now_us);
    }
    const AttitudeState state = filter.state();
    double square = 0;
    for (int32_t part : state.gravity_q30) square += std::pow(std::ldexp(part, -30), 2);
    CHECK(square == doctest::Approx(1).epsilon(0.2));
    CHECK(std::abs(filter.attitude().pitch_cdeg) <= 9000);
  }
}
