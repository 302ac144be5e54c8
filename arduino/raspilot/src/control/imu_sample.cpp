#include "imu_sample.h"

namespace raspilot {

bool is_garbage(const ImuSample& sample) {
  uint16_t ones = 0xFFFF;
  uint16_t any = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int16_t gyro = sample.gyro[axis];
    if (gyro >= 32767 || gyro <= -32767) return true;
    const uint16_t accel = static_cast<uint16_t>(sample.accel[axis]);
    any |= accel;
    ones &= accel & static_cast<uint16_t>(gyro);
  }
  // Not even a falling aircraft measures 0 to the last bit on three axes.
  return any == 0 || ones == 0xFFFF;
}

uint16_t fingerprint(const ImuSample& sample) {
  uint16_t print = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    print = static_cast<uint16_t>(print * 2 + static_cast<uint16_t>(sample.accel[axis]));
    print = static_cast<uint16_t>(print * 2 + static_cast<uint16_t>(sample.gyro[axis]));
  }
  return print;
}

}  // namespace raspilot
