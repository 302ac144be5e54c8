/** Attitude from gyro and accelerometer in fixed point, at the loop rate. */
#pragma once

#include "../core/types.h"
#include "../store/calibration.h"
#include "imu_sample.h"
#include "level.h"
#include "stillness.h"

namespace raspilot {

struct AttitudeState {
  int32_t gravity_q30[3];
  int32_t yaw_q;  // as the filter keeps it
  int16_t gyro_bias_16[3];
};

/**
 * A Mahony filter on the direction of gravity: the gyro turns it at 500 Hz, the accelerometer draws
 * it with a time constant of 16 s while it measures about 1 g and the aircraft does not turn, and
 * what it draws away steadily is learned as the gyro's drift. Yaw is integrated, nothing holds it.
 */
class AttitudeFilter {
 public:
  /** Reads bias and level offsets with the first sample and after calibrating. */
  explicit AttitudeFilter(Calibration& calibration);

  /** Takes a sample; the time since the last one is counted in slots of 2000 us. */
  void on_sample(const ImuSample& sample, uint32_t now_us);
  /** A slot without a sample. */
  void on_missing(uint32_t now_us);

  const Attitude& attitude() const { return attitude_; }
  /** Samples come, are no copies of each other for 50 ms, and gravity has been found. */
  bool is_valid() const { return is_fresh_ && has_gravity_; }
  /** Age of the newest sample, ms, at most 65535. */
  uint16_t age_ms(uint32_t now_us) const;

  /**
   * Gyro bias from stillness at start; never while armed. True while it looks for it, 10 s at
   * most: a still second that comes later, still disarmed, is taken all the same.
   */
  bool is_calibrating() const { return is_looking_ && search_slots_ != 0; }
  bool is_bias_from_eeprom() const { return is_bias_from_eeprom_; }
  /** Whether the aircraft has been still for the last second. */
  bool is_still() const { return stillness_.is_still(); }
  /** `e` 3: NONE when the bias of the still second was taken into the calibration. */
  Reason calibrate_gyro();
  /** `e` 0: this attitude is level; out of range beyond 30 degrees. */
  Reason calibrate_level();
  /** Armed aircraft stop the search for stillness. */
  void stop_calibrating() { is_looking_ = false; }

  AttitudeState state() const;
  void restore(const AttitudeState& state, uint32_t now_us);

 private:
  void begin();
  bool is_copy(const ImuSample& sample);
  void follow_stillness(const int16_t* gyro);
  void take_bias(const int16_t* bias_q4);
  void pass(uint32_t now_us);
  void lose();
  /** Of one axis, rad per slot, Q32. */
  int32_t bias_of(uint8_t axis) const;
  void integrate(const int16_t* gyro);
  /** Gravity's direction in Q14. */
  void find_down(int16_t* down) const;
  void turn_gravity(const int16_t* angle);
  void normalize();
  void integrate_yaw(const int16_t* angle);
  void collect(const int16_t* gravity);
  void correct();
  void draw(uint8_t shift);
  void learn_drift();
  bool is_turning() const;
  void find_angles();

  Calibration& calibration_;
  Attitude attitude_;
  Level level_;
  Stillness stillness_;
  int32_t gravity_[3];        // direction of down in body axes, Q30
  int32_t base_bias_[3];      // rad per slot, Q32: by calibration
  int32_t drift_[3];          // rad per slot, Q36: learned since
  int16_t remainder_[3];      // of the angle of a slot, rad Q32
  int16_t measured_[3];       // four samples of the accelerometer as down, Q14 of 1 g
  uint32_t yaw_;              // a full circle is 2^32
  int32_t yaw_change_ = 0;    // not yet in yaw_, rad Q31 times cosine of pitch squared
  int32_t turn_rate_ = 0;     // of the turn about the vertical, rad per slot Q19, times 64
  uint32_t newest_us_ = 0;
  uint16_t print_ = 0;
  uint16_t search_slots_;
  uint8_t copies_ = 0;
  uint8_t good_samples_ = 0;
  uint8_t pending_slots_ = 0;
  uint8_t phase_ = 0;
  uint8_t found_groups_ = 0;  // groups of four samples since gravity was looked for
  bool has_begun_ = false;
  bool has_sample_ = false;
  bool is_fresh_ = false;
  bool has_gravity_ = false;
  bool is_looking_ = true;
  bool is_bias_from_eeprom_ = true;
};

}  // namespace raspilot
