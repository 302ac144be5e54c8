/** The attitude filter with an IMU whose rotation a test sets. */
#pragma once

#include <cmath>

#include "control/attitude_filter.h"
#include "moving_imu.h"

namespace raspilot {

/** The filter with an IMU whose rotation the test sets, slot by slot. */
struct Flight {
  Calibration calibration = DEFAULT_CALIBRATION;
  AttitudeFilter filter{calibration};
  MovingImu imu;

  explicit Flight(double seconds = 0) { fly(seconds); }
  void slot(double p = 0, double q = 0, double r = 0) {
    imu.turn(p, q, r);
    filter.on_sample(imu.sample());
  }
  void slot_with_force(double p, double q, double r, const double* force_g) {
    imu.turn(p, q, r);
    filter.on_sample(imu.sample(force_g));
  }
  void fly(double seconds, double p = 0, double q = 0, double r = 0) {
    for (int slots = static_cast<int>(seconds * 500); slots > 0; --slots) slot(p, q, r);
  }
  void miss() { filter.on_missing(); }
  void miss(double seconds) {
    for (int slots = static_cast<int>(seconds * 500); slots > 0; --slots) miss();
  }

  double roll_deg() const { return filter.attitude().roll_cdeg / 100.0; }
  double pitch_deg() const { return filter.attitude().pitch_cdeg / 100.0; }
  double bias_deg_s(int axis) const {
    return std::ldexp(filter.state().bias_q36[axis], -36) / 0.002 / DEG;
  }
  double yaw_deg() const { return filter.attitude().yaw_cdeg / 100.0; }
  /** Angle between the filter's and the true direction of down. */
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

/** A coordinated turn: the felt force is normal to the floor, greater with a steeper bank. */
inline void turn(Flight& flight, double bank_deg, double speed_m_s, double seconds) {
  const double bank = bank_deg * DEG;
  const double rate_deg_s = GRAVITY_M_S2 * std::tan(bank) / speed_m_s / DEG;
  const double force[3] = {0, 0, -1 / std::cos(bank)};
  for (int slots = static_cast<int>(seconds * 500); slots > 0; --slots) {
    flight.slot_with_force(0, rate_deg_s * std::sin(bank), rate_deg_s * std::cos(bank), force);
  }
}

/** Rolls at 45 deg/s to a bank. */
inline void roll_to(Flight& flight, double bank_deg) {
  const double now_deg = flight.imu.roll_deg();
  const double seconds = std::fabs(bank_deg - now_deg) / 45;
  flight.fly(seconds, bank_deg > now_deg ? 45 : -45);
}

}  // namespace raspilot
