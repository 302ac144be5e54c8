/** The inertial sensor's measurements, as in the MPU6050's registers. */
#pragma once

#include <stdint.h>

namespace raspilot {

/**
 * One burst of the MPU6050 from ACCEL_XOUT_H, in the chip's axes (register map 4.17 to 4.19), which
 * lies x forward, y left, z up: level at rest its z reads +1 g.
 */
struct ImuSample {
  int16_t accel[3];
  int16_t temperature;
  int16_t gyro[3];
};

/** Ranges that the chip is set to: +-8 g (AFS_SEL 2) and +-1000 deg/s (FS_SEL 2, 32.8 a deg/s). */
constexpr int16_t ACCEL_PER_G = 4096;
constexpr int16_t GYRO_PER_10_DEG_S = 328;

/** Whether no working sensor sends this: all bits alike. */
bool is_garbage(const ImuSample& sample);
/** Whether a gyro axis is at its end stop: the aircraft turns faster than 1000 deg/s. */
bool is_saturated(const ImuSample& sample);

/** Sixteen bits that differ when samples differ, except for about one noisy pair in a hundred. */
uint16_t fingerprint(const ImuSample& sample);

}  // namespace raspilot
