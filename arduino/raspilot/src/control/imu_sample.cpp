#include "imu_sample.h"

namespace raspilot {

namespace {

constexpr int16_t END_STOP = 32767;

bool is_at_end_stop(int16_t value) { return value >= END_STOP || value <= -END_STOP; }

uint16_t mixed(uint16_t print, int16_t value) {
  return static_cast<uint16_t>((print << 1 | print >> 15) ^ static_cast<uint16_t>(value));
}

}  // namespace

bool is_garbage(const ImuSample& sample) {
  bool is_all_zero = true;
  bool is_all_one = true;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    if (is_at_end_stop(sample.gyro[axis])) return true;
    is_all_zero = is_all_zero && sample.accel[axis] == 0;
    is_all_one = is_all_one && sample.accel[axis] == -1 && sample.gyro[axis] == -1;
  }
  // A falling aircraft does not measure 0 to the last bit on three axes.
  return is_all_zero || is_all_one;
}

uint16_t fingerprint(const ImuSample& sample) {
  uint16_t print = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    print = mixed(print, sample.accel[axis]);
    print = mixed(print, sample.gyro[axis]);
  }
  return print;
}

}  // namespace raspilot
