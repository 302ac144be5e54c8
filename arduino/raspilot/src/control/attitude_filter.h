/** Attitude from gyro and accelerometer in fixed point, at the loop rate. */
#pragma once

#include "../core/types.h"
#include "../store/calibration.h"
#include "imu_sample.h"
#include "level.h"
#include "stillness.h"

namespace raspilot {

/** What the filter has found, as it keeps it and as it survives a reset. */
struct AttitudeState {
  int32_t gravity_q30[3];  // direction of down in body axes
  int32_t bias_q36[3];     // of the gyro, rad per slot
  uint32_t yaw;            // a full circle is 2^32
  bool has_own_bias;       // found since power-on, not EEPROM's
};

/**
 * Everything else that the filter remembers; all of it zero at first. What is used most comes first:
 * the chip reaches 64 bytes of an object by short instructions.
 */
struct AttitudeMemory {
  bool has_begun_;
  bool has_sample_;
  bool is_fresh_;
  bool has_gravity_;
  bool has_ended_search_;
  uint8_t copies_;
  uint8_t good_samples_;
  uint8_t distrust_;
  uint8_t pending_slots_;
  uint8_t phase_;
  uint8_t found_groups_;  // groups of four samples since gravity was looked for
  uint16_t print_;
  int8_t gyro_[3];        // upper halves of the newest sample's
  uint16_t searched_slots_;
  uint16_t missing_slots_;  // since the newest sample
  int32_t yaw_change_;      // not yet in yaw, rad Q31 times cosine of pitch squared
  int32_t turn_rate_;       // of the turn about the vertical, rad per slot Q19, times 64
  int16_t down_[3];         // gravity_q30 in Q14
  Attitude attitude_;
  int16_t measured_[3];   // four samples of the accelerometer as down, Q14 of 1 g
  int16_t remainder_[3];  // of the angle of a slot, rad Q32
  AttitudeState state_;
  Level level_;
  Stillness stillness_;
};

/**
 * A Mahony filter on the direction of gravity: the gyro turns it at 500 Hz, the accelerometer draws
 * it with a time constant of 16 s while it measures about 1 g and the aircraft does not turn, and
 * what it draws away steadily is learned as the gyro's drift. Yaw is integrated, nothing holds it.
 * Roll and yaw are computed in one slot, pitch in the next: 250 Hz.
 */
class AttitudeFilter : private AttitudeMemory {
 public:
  /** Reads bias and level offsets with the first sample and after calibrating. */
  explicit AttitudeFilter(Calibration& calibration);

  /** Takes the sample of a slot; each slot of 2000 us has this or on_missing(). */
  void on_sample(const ImuSample& sample, uint32_t now_us);
  /** A slot without a sample. */
  void on_missing(uint32_t now_us);

  const Attitude& attitude() const { return attitude_; }
  /**
   * Samples come, are no copies of each other for 50 ms, make sense, and gravity has been found.
   */
  bool is_valid() const { return is_fresh_ && has_gravity_; }
  /** Age of the newest sample, ms, counted in slots, at most 65535. */
  uint16_t age_ms(uint32_t now_us) const;

  /**
   * Gyro bias from stillness at start; never while armed. True while it looks for it, 10 s at
   * most: later the aircraft may fly, and a steady turn is still too.
   */
  bool is_calibrating() const;
  bool is_bias_from_eeprom() const { return !state_.has_own_bias; }
  /** Whether the aircraft has been still for the last second. */
  bool is_still() const { return stillness_.is_still(); }
  /** `e` 3: NONE when the bias of the still second was taken into the calibration. */
  Reason calibrate_gyro();
  /** `e` 0: this attitude is level; out of range beyond 15 degrees. */
  Reason calibrate_level();
  /** Armed aircraft stop the search for stillness. */
  void stop_calibrating() { has_ended_search_ = true; }

  const AttitudeState& state() const { return state_; }
  void restore(const AttitudeState& state, uint32_t now_us);

 private:
  void begin();
  void miss();
  bool is_copy(const ImuSample& sample);
  bool is_senseless(const ImuSample& sample);
  void take_own_bias();
  void count_slots();
  void lose();
  void collect(const ImuSample& sample);
  void integrate(const int16_t* gyro);
  void integrate_yaw(const int16_t* angle);
  void normalize();
  void find_down();
  void correct();
  void draw(uint8_t shift);
  void learn_drift();
  void find_roll_and_yaw();
  void find_pitch();
  void find_angles();
  Reason refusal() const;

  Calibration& calibration_;
};

}  // namespace raspilot
