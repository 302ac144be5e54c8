/** Kalman filter of the attitude's errors: tilt, gyro bias, and the airspeed that turns need. */
#pragma once

#include "../core/compiler.h"
#include "../core/types.h"

namespace raspilot {

/** A part of what a cycle of the filter found, in body axes (x forward, y right, z down). */
struct TiltCorrection {
  /** Rotation from the estimated to the true attitude, rad. */
  int16_t rotation_q17[3];
  /** To be added to the gyro bias, rad a slot. */
  int16_t bias_q28[3];
};

/**
 * Six states: tilt error about the horizontal axes forward and right, gyro bias on three axes,
 * airspeed. A cycle of 286 ms takes 16 groups of four samples (128 ms), then one short piece of
 * arithmetic in three of four slots, in floating point.
 *
 * An accelerometer feels gravity less the acceleration of flight, which is the turn rate times the
 * airspeed across the nose, and the change of airspeed along it. The filter expects both. So no
 * turn is gated out, and bias is learned in turns, too. The airspeed itself is integrated, held
 * near its mean, and shown by turns: a tilt error is fixed to the earth and rotates through the
 * body axes, the centripetal force does not. In a turn the load along down, 1 g on average, shows a
 * roll error whatever the airspeed. The yaw gyro's bias is learned where bank makes it a pitch
 * rate, and in straight flight. Bias that drifts steadily is extrapolated.
 */
class TiltFilter {
 public:
  /**
   * Starts over with these uncertainties (1 sigma): tilt in degrees, gyro bias in tenths of a
   * deg/s. An implausible speed (m/s) becomes the default.
   */
  void begin(uint8_t tilt_deg, uint8_t bias_10, float speed_m_s);
  /** Samples are missing: the tilt may have changed by `tilt_deg`. The cycle starts over. */
  void widen(uint8_t tilt_deg);
  /** The tilt was found in flight, or is far off: for seconds it follows the accelerometer. */
  void lose();
  /**
   * Takes the turn's force out of two axes of a direction of down that the accelerometer measured,
   * Q13; returns the force a rate makes, in Q13 times 512.
   */
  int16_t take_out_turn(int16_t& right_q13, int16_t& down_q13, int16_t pitch_rate_16,
                        int16_t yaw_rate_16) const;
  /** An airspeed that was measured, cm/s: the next cycle takes it in place of the mean. */
  void take_airspeed(int16_t cm_s) { measured_cm_s_ = cm_s; }
  /** 128 and the acceleration along the nose in the last cycle, 1/64 g. */
  uint8_t acceleration() const { return static_cast<uint8_t>(128 + (pitch_error_ >> 7)); }
  /** Mean airspeed. */
  float speed_m_s() const { return mean_speed_; }

  /**
   * Takes a group: measured less estimated direction of down (Q13 of 1 g) in body axes, and the
   * body rates, sixteenths of a deg/s.
   */
  void collect(const int16_t* difference_q13, int16_t pitch_rate_16, int16_t yaw_rate_16);
  /** One piece of a cycle; true when a correction of the attitude is ready. */
  bool step(const Attitude& attitude, TiltCorrection& correction);

 private:
  enum State : uint8_t { ROLL, PITCH, BIAS_X, BIAS_Y, BIAS_Z, SPEED, STATES };
  enum Sum : uint8_t { X, Y, Z, PITCH_RATE, YAW_RATE, SUMS };

  bool is_lost() const;
  float& covariance(uint8_t row, uint8_t column);
  void restart();
  void add_noise(float tilt, float bias, float speed);
  void add(uint8_t to, uint8_t from, float factor);
  void find_turn(const Attitude& attitude);
  void find_errors(const Attitude& attitude);
  int16_t mean(Sum sum) const;
  void predict(uint8_t piece, const Attitude& attitude);
  void observe(State tilt, int16_t error);
  void begin_observation(uint8_t subject, const Attitude& attitude);
  void update(uint8_t piece);
  bool finish(uint8_t piece, const Attitude& attitude, TiltCorrection& correction);

  // All zero at first, by its owner; begin() comes before anything else. The chip reaches the
  // first 64 bytes by short instructions.
  uint8_t piece_;
  uint8_t groups_;
  int16_t roll_error_;  // Q13
  int16_t pitch_error_;
  int16_t load_factor_error_;
  uint8_t lost_cycles_;  // far off, from LOST_CYCLES on lost
  bool is_one_g_;
  uint8_t cycles_;
  bool is_measured_;  // the airspeed, in this cycle
  int16_t measured_cm_s_;  // 0: none since the last cycle
  float innovation_;
  float variance_;
  float turn_rate_;  // about the vertical, rad/s
  float noise_;      // variance of the force, g squared
  float speed_;      // m/s
  float mean_speed_;
  float mean_share_;  // of a cycle in the mean
  float drift_[3];   // rad/s a cycle
  union {
    float gains_[STATES];  // covariance of the states with the observation
    int32_t sums_[SUMS];
  };
  float change_[STATES];
  float weights_[STATES];  // of the states in the observation
  float covariance_[STATES * (STATES + 1) / 2];  // lower triangle, row by row
};

}  // namespace raspilot
