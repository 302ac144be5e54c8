#include "imu_sample.h"

namespace raspilot {

bool is_garbage(const ImuSample& sample) {
  uint16_t ones = 0xFFFF;
  uint16_t any = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const uint16_t accel = static_cast<uint16_t>(sample.accel[axis]);
    any |= accel;
    ones &= accel & static_cast<uint16_t>(sample.gyro[axis]);
  }
  // Not even a falling aircraft measures 0 to the last bit on three axes.
  return any == 0 || ones == 0xFFFF;
}

bool is_saturated(const ImuSample& sample) {
  for (const int16_t rate : sample.gyro) {
    if (rate == 32767 || rate <= -32767) return true;
  }
  return false;
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
