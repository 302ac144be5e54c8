#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "attitude_flight.h"

using namespace raspilot;

TEST_CASE("a still second at start gives the bias and sets the flag") {
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

TEST_CASE("without stillness the bias of the calibration flies, and arming waits 10 s for it") {
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
  SUBCASE("the search continues") {
    flight.fly(1.2);
    CHECK_FALSE(flight.filter.is_bias_from_eeprom());
  }
  SUBCASE("until it is ended: a steady turn is still, too; then it takes a Command") {
    flight.filter.stop_calibrating();
    flight.fly(1.2);
    CHECK(flight.filter.is_bias_from_eeprom());
    CHECK(flight.filter.calibrate_gyro() == Reason::NONE);
    CHECK_FALSE(flight.filter.is_bias_from_eeprom());
  }
}

TEST_CASE("without any bias the aircraft is calibrating until a still second, however long") {
  Flight flight;
  for (int slot = 0; slot < 15000; ++slot) {
    flight.slot(5 * std::sin(slot * 0.05), 0, 0);
    REQUIRE(flight.filter.is_calibrating());
  }
  flight.filter.stop_calibrating();
  CHECK(flight.filter.is_calibrating());
  CHECK_FALSE(flight.filter.has_bias());
}

TEST_CASE("the bias of power-on is new once: when half a deg/s differs from the calibration") {
  Flight flight;
  flight.imu.bias_deg_s[1] = 2;
  flight.fly(1.2);
  CHECK(flight.filter.take_new_bias());
  CHECK_FALSE(flight.filter.take_new_bias());
  CHECK(std::abs(flight.calibration.gyro_bias_16[1] - 32) <= 1);
  for (double bias : {2.4, 2.7}) {
    Flight next;
    next.calibration = flight.calibration;
    next.imu.bias_deg_s[1] = bias;
    next.fly(1.2);
    CHECK(next.filter.take_new_bias() == (bias > 2.5));
  }
}

TEST_CASE("an armed aircraft never takes stillness for bias") {
  Flight flight;
  flight.calibration.gyro_bias_16[0] = 1;
  flight.filter.begin();
  flight.filter.stop_calibrating();
  CHECK_FALSE(flight.filter.is_calibrating());
  flight.imu.set(12, 0);
  turn(flight, 12, 12, 10);
  CHECK(flight.filter.is_still());
  CHECK(flight.filter.is_bias_from_eeprom());
  CHECK(std::fabs(flight.bias_deg_s(2)) <= 0.5);
}

TEST_CASE("a turn that begins between two still seconds does not count as still") {
  Flight flight;
  flight.imu.gyro_noise_deg_s = 0.02;
  for (int slot = 0; slot < 512; ++slot) flight.slot();
  CHECK(flight.filter.is_still());
  flight.slot(0, 0, 15);
  CHECK_FALSE(flight.filter.is_still());
}

TEST_CASE("a copied, a silent or a broken IMU is invalid within 100 ms") {
  Flight flight(2);
  CHECK(flight.filter.is_valid());
  SUBCASE("the same sample again and again") {
    const ImuSample sample = flight.imu.sample();
    int slots = 0;
    for (; flight.filter.is_valid() && slots < 500; ++slots) flight.filter.on_sample(sample);
    CHECK(slots == 25);
    flight.miss(0.2);
    CHECK(flight.filter.age_ms() >= 200);
  }
  SUBCASE("no sample") {
    int slots = 0;
    for (; flight.filter.is_valid() && slots < 500; ++slots) flight.miss();
    CHECK(slots == 25);
    CHECK(flight.filter.age_ms() == 50);
  }
  SUBCASE("all zero, all ones") {
    ImuSample broken = flight.imu.sample();
    for (int kind = 0; kind < 2; ++kind) {
      CAPTURE(kind);
      if (kind == 0) broken = {{0, 0, 0}, 0, {0, 0, 0}};
      if (kind == 1) broken = {{-1, -1, -1}, -1, {-1, -1, -1}};
      flight.fly(0.3);
      CHECK(flight.filter.is_valid());
      for (int slot = 0; slot < 26; ++slot) flight.filter.on_sample(broken);
      CHECK_FALSE(flight.filter.is_valid());
    }
  }
  flight.fly(0.3);
  CHECK(flight.filter.is_valid());
  CHECK(flight.tilt_error_deg() <= 1.0);
}

TEST_CASE("a roll beyond 1000 deg/s is flown through; a gyro that stays at its end stop is broken") {
  for (double rate_deg_s : {1300.0, -1300.0}) {
    Flight flight(3);
    // The fastest roll that may begin within 20 ms.
    for (int slot = 1; slot <= 10; ++slot) flight.slot(rate_deg_s * slot / 10);
    for (int slot = 0; slot < 200; ++slot) {
      flight.slot(rate_deg_s);
      REQUIRE(flight.filter.is_valid());
    }
    int slots = 200;
    for (; flight.filter.is_valid() && slots < 500; ++slots) flight.slot(rate_deg_s);
    CHECK(slots < 300);
  }
}

TEST_CASE("one good sample among missing ones does not make the IMU valid") {
  Flight flight(2);
  flight.miss(0.1);
  for (int round = 0; round < 20; ++round) {
    flight.slot();
    CHECK_FALSE(flight.filter.is_valid());
    flight.miss(0.06);
  }
}

TEST_CASE("samples that were missed are made up for") {
  Flight flight(3);
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

TEST_CASE("an IMU that returns after a long loss finds gravity again") {
  Flight flight(2);
  flight.miss(1.0);
  flight.imu.set(50, -10);
  flight.fly(0.1);
  CHECK_FALSE(flight.filter.is_valid());
  flight.fly(0.1);
  CHECK(flight.filter.is_valid());
  CHECK(flight.tilt_error_deg() <= 1.0);
}

TEST_CASE("the age of the newest sample saturates") {
  Flight flight;
  CHECK(flight.filter.age_ms() == 65535);
  flight.slot();
  CHECK(flight.filter.age_ms() == 0);
  flight.miss(1);
  CHECK(flight.filter.age_ms() == 1000);
  flight.miss(200);
  CHECK(flight.filter.age_ms() == 65535);
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
  // After the next start the calibration's bias is used until a still second.
  AttitudeFilter next(flight.calibration);
  next.stop_calibrating();
  for (int slot = 0; slot < 100; ++slot) next.on_sample(flight.imu.sample());
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

TEST_CASE("after seconds without samples in a turn down is found without the force of the turn") {
  for (double bank_deg : {20.0, -42.0, 55.0}) {
    CAPTURE(bank_deg);
    Flight flight(2);
    roll_to(flight, bank_deg);
    turn(flight, bank_deg, 13, 2);
    flight.miss(3);
    turn(flight, bank_deg, 13, 0.3);
    CHECK(flight.filter.is_valid());
    CHECK(flight.tilt_error_deg() <= 4);
    turn(flight, bank_deg, 13, 5);
    CHECK(flight.tilt_error_deg() <= 4);
  }
}

TEST_CASE("down that was found while the airspeed rose is right within three seconds") {
  Flight flight(2);
  flight.miss(3);
  const double dive[3] = {0.4, 0, -1};
  for (int slot = 0; slot < 100; ++slot) flight.slot_with_force(0, 0, 0, dive);
  CHECK(flight.tilt_error_deg() >= 15);
  flight.fly(3);
  CHECK(flight.tilt_error_deg() <= 11);
}
