/** Attitude from gyro and accelerometer in fixed point, at the loop rate. */
#pragma once

#include "../core/types.h"
#include "../store/calibration.h"

namespace raspilot {

/** One burst of the MPU6050 from ACCEL_XOUT_H, in the chip's axes (register map 4.17 to 4.19). */
struct ImuSample {
  int16_t accel[3];
  int16_t temperature;
  int16_t gyro[3];
};

struct AttitudeState {
  int32_t gravity_q30[3];
  int32_t yaw_q;  // as the filter keeps it
  int16_t gyro_bias_16[3];
};

class AttitudeFilter {
 public:
  /** Reads bias and level offsets when it begins and after calibrating. */
  explicit AttitudeFilter(Calibration& calibration);

  /** Takes a sample; `elapsed_us` since the last one taken (nominal 2000). */
  void on_sample(const ImuSample& sample, uint32_t now_us);
  /** A slot without a sample. */
  void on_missing(uint32_t now_us);

  const Attitude& attitude() const;
  /** Samples come, are no copies of each other for 50 ms, and gravity has been found. */
  bool is_valid() const;
  /** Age of the newest sample, ms, at most 65535. */
  uint16_t age_ms(uint32_t now_us) const;

  /** Gyro bias from stillness at start; never while armed. True while it looks for it. */
  bool is_calibrating() const;
  bool is_bias_from_eeprom() const;
  /** Whether the aircraft has been still for the last second. */
  bool is_still() const;
  /** `e` 3: NONE when the bias of the still second was taken into the calibration. */
  Reason calibrate_gyro();
  /** `e` 0: this attitude is level. */
  Reason calibrate_level();
  /** Armed aircraft stop the search for stillness. */
  void stop_calibrating();

  AttitudeState state() const;
  void restore(const AttitudeState& state, uint32_t now_us);
};

}  // namespace raspilot
