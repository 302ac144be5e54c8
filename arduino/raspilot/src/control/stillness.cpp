#include "stillness.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr uint16_t WINDOW = 256;
constexpr int16_t MAX_CHANGE = 40;  // 256 of them fit in 16 bits; 1.2 deg/s
constexpr int16_t MAX_BIAS = 656;   // 20 deg/s (data sheet 6.1)

}  // namespace

OUT_OF_LINE void Stillness::reset() {
  samples_ = 0;
  is_still_ = false;
}

bool Stillness::on_sample(const int16_t* gyro) {
  int16_t changes[3];
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int16_t rate = clamped16(gyro[axis], MAX_BIAS);
    changes[axis] = static_cast<int16_t>(rate - first_[axis]);
    if (rate != gyro[axis] || clamped16(changes[axis], MAX_CHANGE) != changes[axis]) reset();
  }
  for (uint8_t axis = 0; axis < 3; ++axis) {
    if (samples_ == 0) {
      first_[axis] = gyro[axis];
      sums_[axis] = changes[axis] = 0;
    }
    sums_[axis] = static_cast<int16_t>(sums_[axis] + changes[axis]);
  }
  if (++samples_ < WINDOW) return false;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int16_t mean_q4 = static_cast<int16_t>(first_[axis] * 16 + (sums_[axis] + 8) / 16);
    mean_q4_[axis] = mean_q4;
  }
  samples_ = 0;
  is_still_ = true;
  return true;
}

}  // namespace raspilot
