#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "attitude_flight.h"

using namespace raspilot;

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
  Flight flight(3);
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

TEST_CASE("two minutes at 30 degrees of bank stay within 3 degrees at any speed") {
  for (double bias : {0.05, -0.05}) {
    for (double speed_m_s : {10.0, 15.0, 25.0}) {
      Flight flight(3);
      for (int axis = 0; axis < 3; ++axis) flight.imu.bias_deg_s[axis] = bias;
      roll_to(flight, 30);
      double greatest = 0;
      for (int second = 0; second < 120; ++second) {
        turn(flight, 30, speed_m_s, 1);
        greatest = std::fmax(greatest, flight.tilt_error_deg());
      }
      MESSAGE("bias " << bias << " deg/s, " << speed_m_s << " m/s: " << greatest << " deg");
      CHECK(greatest <= 3.0);
      roll_to(flight, 0);
      flight.fly(60);
      CHECK(flight.tilt_error_deg() <= 2.0);
    }
  }
}

TEST_CASE("two minutes at 15, 20 and 30 degrees of bank stay within 2 degrees at the usual speeds") {
  for (double bank_deg : {15.0, 20.0, 30.0, -20.0}) {
    for (double speed_m_s : {10.0, 13.0, 16.0}) {
      CAPTURE(bank_deg);
      CAPTURE(speed_m_s);
      Flight flight(3);
      for (int axis = 0; axis < 3; ++axis) flight.imu.bias_deg_s[axis] = 0.05 - 0.05 * axis;
      roll_to(flight, bank_deg);
      double greatest = 0;
      for (int second = 0; second < 120; ++second) {
        turn(flight, bank_deg, speed_m_s, 1);
        greatest = std::fmax(greatest, flight.tilt_error_deg());
      }
      CHECK(greatest <= 2.0);
    }
  }
}

TEST_CASE("a bias of the yaw gyro locks nothing out: level and still, attitude comes back") {
  for (double bias_deg_s : {3.0, -4.0}) {
    CAPTURE(bias_deg_s);
    Flight flight(3);
    // It appears without having been measured, and the attitude is wrong by 39 degrees.
    flight.imu.bias_deg_s[2] = bias_deg_s;
    AttitudeState state = flight.filter.state();
    state.gravity_q30[1] = static_cast<int32_t>(std::sin(39 * DEG) * (1L << 30));
    state.gravity_q30[2] = static_cast<int32_t>(std::cos(39 * DEG) * (1L << 30));
    flight.filter.restore(state);
    flight.fly(60);
    CHECK(flight.tilt_error_deg() <= 8.0);
    flight.fly(240);
    CHECK(flight.tilt_error_deg() <= 3.0);
  }
}

TEST_CASE("a gyro that warms up by 4 deg/s in ten minutes leaves attitude within 3 degrees") {
  Flight flight(3);
  double greatest = 0;
  for (int second = 0; second < 600; ++second) {
    for (int axis = 0; axis < 3; ++axis) {
      flight.imu.bias_deg_s[axis] = (axis == 1 ? -4.0 : 4.0) * second / 600;
    }
    // Level, then a turn each way, as a pilot flies.
    const int leg = second / 20 % 4;
    const double bank_deg = leg == 1 ? 25 : leg == 3 ? -15 : 0;
    roll_to(flight, bank_deg);
    turn(flight, bank_deg, 13, 1);
    greatest = std::fmax(greatest, flight.tilt_error_deg());
  }
  CHECK(greatest <= 3.0);
}

TEST_CASE("a push that feels like more than 1 g tilts nothing") {
  Flight flight(4);
  // 0.6 g for 10 s: a launch by a bungee, or a dive.
  const double force[3] = {0.6, 0, -1};
  for (int slot = 0; slot < 5000; ++slot) flight.slot_with_force(0, 0, 0, force);
  CHECK(flight.tilt_error_deg() <= 1.0);
}

TEST_CASE("a long acceleration along the nose tilts it little") {
  Flight flight(4);
  // 0.3 g for 3 s: a throttle opened.
  const double force[3] = {0.3, 0, -1};
  for (int slot = 0; slot < 1500; ++slot) flight.slot_with_force(0, 0, 0, force);
  CHECK(flight.tilt_error_deg() <= 4.0);
}

TEST_CASE("the gyro's bias in level flight is learned") {
  Flight flight(3);
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
  CHECK(flight.tilt_error_deg() <= 3.0);
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
  Flight flight(3);
  roll_to(flight, 45);
  const double before_deg = flight.yaw_deg() - flight.imu.yaw_deg;
  turn(flight, 45, 15, 20);
  CHECK(std::fabs(std::remainder(flight.yaw_deg() - flight.imu.yaw_deg - before_deg, 360)) <= 3.0);
}

TEST_CASE("after a reset in flight attitude, yaw and bias are restored immediately") {
  Flight flight;
  flight.imu.bias_deg_s[0] = 2;
  flight.fly(3);
  roll_to(flight, 40);
  flight.fly(0.4, 0, 0, 30);
  const AttitudeState state = flight.filter.state();

  AttitudeFilter next(flight.calibration);
  next.restore(state);
  CHECK_FALSE(next.is_valid());
  CHECK_FALSE(next.is_calibrating());
  CHECK(next.state().speed_m_s == state.speed_m_s);
  CHECK(std::abs(next.attitude().roll_cdeg - flight.filter.attitude().roll_cdeg) <= 5);
  CHECK(std::abs(next.attitude().yaw_cdeg - flight.filter.attitude().yaw_cdeg) <= 5);
  flight.imu.turn(0, 0, 0);
  for (int slot = 0; slot < 15; ++slot) next.on_sample(flight.imu.sample());
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
    const bool is_extreme = round % 2 != 0;
    int rates[3] = {0, 0, 0};
    for (int slot = 0; slot < 2000; ++slot) {
      ImuSample sample;
      for (int axis = 0; axis < 3; ++axis) {
        sample.accel[axis] = static_cast<int16_t>(is_extreme ? (random() % 2 ? 32767 : -32768)
                                                             : any(random));
        // As fast as a sensor's rates change, and mostly at their ends when extreme.
        const int step = is_extreme ? (random() % 32 < 16 ? 15000 : -15000) : any(random) / 3;
        rates[axis] = std::max(-32766, std::min(32766, rates[axis] + step));
        sample.gyro[axis] = static_cast<int16_t>(rates[axis]);
      }
      if (slot % 7 == 0) {
        for (int axis = 0; axis < 3; ++axis) sample.accel[axis] /= 8;
      }
      filter.on_sample(sample);
      if (random() % 16 == 0) filter.on_missing();
      if (random() % 512 == 0) filter.restore(filter.state());
    }
    const AttitudeState state = filter.state();
    double square = 0;
    for (int32_t part : state.gravity_q30) square += std::pow(std::ldexp(part, -30), 2);
    CHECK(square == doctest::Approx(1).epsilon(0.2));
    CHECK(std::abs(filter.attitude().pitch_cdeg) <= 9000);
  }
}
