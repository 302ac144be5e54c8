/** Attitude from gyro and accelerometer in fixed point, at the loop rate. */
#pragma once

#include "../core/reference.h"
#include "../core/types.h"
#include "../store/calibration.h"
#include "imu_sample.h"
#include "level.h"
#include "stillness.h"
#include "tilt_filter.h"

namespace raspilot {

/** What the filter has found. */
struct AttitudeFound {
  int32_t gravity_q30[3];  // direction of down in body axes
  int32_t bias_q36[3];     // of the gyro, rad per slot
  uint32_t yaw;            // a full circle is 2^32
  bool has_bias : 1;          // measured at some time: since power-on, or kept in EEPROM
  bool has_own_bias : 1;      // measured since power-on
  bool has_ended_search : 1;  // for a still second
};

/** It as it survives a reset. */
struct AttitudeState : AttitudeFound {
  float speed_m_s;  // the airspeed that turns have shown
};

/**
 * Everything else that the filter remembers; initially zero. The most used comes first:
 * the chip reaches 64 bytes of an object by short instructions.
 */
struct AttitudeMemory {
  bool has_begun_;
  bool has_sample_;
  bool is_fresh_;
  bool has_gravity_;
  bool has_lost_gravity_;  // since the start
  bool has_new_bias_;
  uint8_t copies_;
  uint8_t good_samples_;
  uint8_t distrust_;
  uint8_t saturated_slots_;
  uint8_t pending_slots_;
  uint8_t phase_;
  uint8_t found_groups_;  // groups of four samples that gravity is found from
  uint16_t print_;
  int8_t gyro_[3];        // upper halves of the newest sample's
  uint16_t searched_slots_;
  uint16_t missing_slots_;  // since the newest sample
  int32_t yaw_change_;      // not yet in yaw, rad Q31 times cosine of pitch squared
  int16_t down_[3];         // gravity_q30 in Q14
  Attitude attitude_;
  int16_t measured_[3];   // four samples of the accelerometer as down, Q13 of 1 g
  int16_t remainder_[3];  // of the angle of a slot, rad Q32
  AttitudeFound state_;
  Level level_;
  Stillness stillness_;
  TiltFilter tilt_;
};

/**
 * The direction of gravity: the gyro turns it at 500 Hz, a Kalman filter of its errors (TiltFilter)
 * corrects it by the accelerometer four times a second and learns the gyro's bias. Yaw is
 * integrated, nothing holds it. Roll and yaw are computed in one slot, pitch in the next: 250 Hz.
 */
class AttitudeFilter : private AttitudeMemory {
 public:
  explicit AttitudeFilter(Calibration& calibration);
  /** Takes bias and level offsets from the calibration; at the latest the first sample does. */
  void begin();

  /** Takes the sample of a slot; each slot of 2000 us has this or on_missing(). */
  void on_sample(const ImuSample& sample);
  /** A slot without a sample. */
  void on_missing();

  const Attitude& attitude() const { return attitude_; }
  /** Samples arrive, differ within 50 ms, are plausible, and gravity has been found. */
  bool is_valid() const { return is_fresh_ && has_gravity_; }
  /** Age of the newest sample, ms, counted in slots, at most 65535. */
  uint16_t age_ms() const;

  /**
   * Against arming: no bias is known, or the search for a still second is younger than 10 s. The
   * search itself continues until it succeeds or stop_calibrating() ends it.
   */
  bool is_calibrating() const;
  /** The search has had its 10 s. */
  bool has_searched_long() const;
  /** The search found a bias that the calibration did not have; true once. */
  bool take_new_bias();
  bool is_bias_from_eeprom() const { return !state_.has_own_bias; }
  bool has_bias() const { return state_.has_bias; }
  /** Whether the aircraft has been still for the last second. */
  bool is_still() const { return stillness_.is_still(); }
  /** `e` 3: NONE when the bias of the still second was taken into the calibration. */
  Reason calibrate_gyro();
  /** `e` 0: this attitude is level; out of range beyond 15 degrees. */
  Reason calibrate_level();
  /** Ends the search: in flight a steady turn is still, too. */
  void stop_calibrating() { state_.has_ended_search = true; }

  /** `A`: the airspeed that the Raspberry Pi has measured, cm/s. */
  void take_airspeed(int16_t cm_s) { tilt_.take_airspeed(cm_s); }

  /** Of the status: 128 and the acceleration forward, 1/64 g. */
  uint8_t acceleration() const { return tilt_.acceleration(); }

  AttitudeState state() const;
  void restore(const AttitudeState& state);

 private:
  bool is_copy(const ImuSample& sample);
  bool is_senseless(const ImuSample& sample);
  bool has_saturated_long(const ImuSample& sample);
  void use_own_bias();
  void on_still();
  void keep_bias();
  int16_t mean_16(uint8_t axis) const;
  void count_slots();
  void lose();
  void collect(const ImuSample& sample);
  void integrate(const int16_t* gyro);
  void integrate_yaw(const int16_t* angle);
  void normalize();
  void find_down();
  void correct();
  void find_gravity();
  void apply(TiltCorrection& correction);
  void find_roll_and_yaw();
  void find_pitch();
  void find_angles();
  Reason refusal() const;

  Reference<Calibration> calibration_;
};

}  // namespace raspilot
