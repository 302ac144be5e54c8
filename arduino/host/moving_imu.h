/** An aircraft that turns on command, and its MPU6050's readings: the truth for the filter. */
#pragma once

#include <cmath>
#include <random>

#include "control/imu_sample.h"

namespace raspilot {

constexpr double PI = 3.14159265358979323846;
constexpr double DEG = PI / 180;
constexpr double GRAVITY_M_S2 = 9.81;

/**
 * Body axes x forward, y right, z down. `turn` moves on by 2000 us with rates in deg/s and
 * the specific force that the caller gives, in g; `sample` is the chip's reading then.
 */
class MovingImu {
 public:
  double bias_deg_s[3] = {0, 0, 0};
  double gyro_noise_deg_s = 0.06;
  double accel_noise_g = 0.008;
  double down[3] = {0, 0, 1};
  double yaw_deg = 0;
  double rate_deg_s[3] = {0, 0, 0};

  void set(double roll_deg, double pitch_deg) {
    down[0] = -std::sin(pitch_deg * DEG);
    down[1] = std::sin(roll_deg * DEG) * std::cos(pitch_deg * DEG);
    down[2] = std::cos(roll_deg * DEG) * std::cos(pitch_deg * DEG);
  }

  double roll_deg() const { return std::atan2(down[1], down[2]) / DEG; }
  double pitch_deg() const { return std::atan2(-down[0], std::hypot(down[1], down[2])) / DEG; }

  /** Turns for a slot, exactly, about a rotation axis that the body keeps. */
  void turn(double p, double q, double r) {
    rate_deg_s[0] = p;
    rate_deg_s[1] = q;
    rate_deg_s[2] = r;
    const double level = down[1] * down[1] + down[2] * down[2];
    if (level > 1e-6) yaw_deg += (q * down[1] + r * down[2]) / level * SLOT_S;
    const double w[3] = {p * DEG, q * DEG, r * DEG};
    const double size = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    if (size < 1e-12) return;
    const double angle = -size * SLOT_S;
    const double n[3] = {w[0] / size, w[1] / size, w[2] / size};
    const double along = n[0] * down[0] + n[1] * down[1] + n[2] * down[2];
    double turned[3];
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3;
      const int last = (axis + 2) % 3;
      turned[axis] = down[axis] * std::cos(angle) +
                     (n[next] * down[last] - n[last] * down[next]) * std::sin(angle) +
                     n[axis] * along * (1 - std::cos(angle));
    }
    for (int axis = 0; axis < 3; ++axis) down[axis] = turned[axis];
  }

  /** The reading while nothing but gravity is felt. */
  ImuSample sample() {
    const double force[3] = {-down[0], -down[1], -down[2]};
    return sample(force);
  }

  /** The reading with a specific force in body axes, g. */
  ImuSample sample(const double* force_g) {
    ImuSample sample;
    // The chip lies x forward, y left, z up.
    const double signs[3] = {1, -1, -1};
    for (int axis = 0; axis < 3; ++axis) {
      const double force = force_g[axis] + accel_noise_g * normal_(random_);
      const double rate = rate_deg_s[axis] + bias_deg_s[axis] + gyro_noise_deg_s * normal_(random_);
      sample.accel[axis] = counts(signs[axis] * force * ACCEL_PER_G);
      sample.gyro[axis] = counts(signs[axis] * rate * GYRO_PER_10_DEG_S / 10);
    }
    sample.temperature = 0;
    return sample;
  }

 private:
  static constexpr double SLOT_S = 0.002;

  static int16_t counts(double value) {
    return static_cast<int16_t>(std::lround(std::fmax(-32768, std::fmin(32767, value))));
  }

  std::mt19937 random_{7};
  std::normal_distribution<double> normal_{0, 1};
};

}  // namespace raspilot
