#include "stillness.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr uint16_t WINDOW = 512;
constexpr int16_t GREATEST_CHANGE = 40;  // 512 of them fit in 16 bits; 1.2 deg/s
constexpr int16_t GREATEST_BIAS = 1000;  // 30 deg/s: the data sheet's 20 and warmth

}  // namespace

void Stillness::forget() {
  samples_ = 0;
  is_still_ = false;
}

bool Stillness::on_sample(const int16_t* gyro) {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int16_t change = difference_of(gyro[axis], first_[axis]);
    if ((samples_ != 0 || is_still_) && clamped16(change, GREATEST_CHANGE) != change) forget();
    if (clamped16(gyro[axis], GREATEST_BIAS) != gyro[axis]) {
      forget();
      return false;
    }
  }
  for (uint8_t axis = 0; axis < 3; ++axis) {
    if (samples_ == 0) {
      first_[axis] = gyro[axis];
      sums_[axis] = 0;
    }
    sums_[axis] = static_cast<int16_t>(sums_[axis] + (gyro[axis] - first_[axis]));
  }
  if (++samples_ < WINDOW) return false;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    mean_q4_[axis] = static_cast<int16_t>(first_[axis] * 16 + (sums_[axis] + 16) / 32);
  }
  samples_ = 0;
  is_still_ = true;
  return true;
}

}  // namespace raspilot
