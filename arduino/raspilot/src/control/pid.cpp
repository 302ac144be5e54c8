#include "pid.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr float P_ONE = 1024.0f;
// A slot of 2000 us is 1.024 / 512 s: the 512th is a shift.
constexpr float I_ONE = 1024.0f * 1.024f;
constexpr float D_ONE = 16384.0f;
constexpr float GREATEST_D = 3.999f;

// Far above every limit, and three of them still fit.
constexpr int32_t GREATEST_PART = 500000000L;
// Times 125 it fits.
constexpr int32_t GREATEST_SLOPE = 16000000L;
// No aircraft turns by this much in a slot: the angle went round the circle.
constexpr int32_t GREATEST_STEP = 16384L * 256;

uint16_t to_fixed(float gain, float one) { return static_cast<uint16_t>(gain * one + 0.5f); }

}  // namespace

void Pid::tune(const PidGains& gains) {
  p_ = to_fixed(gains.p, P_ONE);
  i_ = to_fixed(gains.i, I_ONE);
  d_ = to_fixed(gains.d > GREATEST_D ? GREATEST_D : gains.d, D_ONE);
  if (i_ == 0) integral_ = 0;
}

void Pid::reset() {
  integral_ = 0;
  has_smooth_ = false;
}

int32_t Pid::update(int16_t error, int16_t measured) {
  int32_t output = clamped(scaled(p_, error), GREATEST_PART);
  if (d_ != 0) output += derivative(measured);
  if (i_ != 0) {
    const int32_t before = integral_;
    integral_ = clamped(integral_ + (scaled(i_, error) >> 3), limit_ * 64);
    const int32_t sum = output + (integral_ >> 6);
    if ((sum > limit_ && error > 0) || (sum < -limit_ && error < 0)) integral_ = before;
    output += integral_ >> 6;
  }
  return clamped(output, limit_);
}

int32_t Pid::derivative(int16_t measured) {
  const int32_t now = measured * static_cast<int32_t>(256);
  const int32_t step = now - smooth_;
  if (!has_smooth_ || clamped(step, GREATEST_STEP) != step) {
    has_smooth_ = true;
    smooth_ = now;
    return 0;
  }
  const int32_t passed = step >> 2;
  smooth_ += passed;
  // Change a slot in 2^-4, times D in 2^-14, is 2^-8 of an output a slot; a second has 500 slots.
  const int32_t slope = clamped(scaled(d_, to_int16(passed >> 4)) >> 4, GREATEST_SLOPE);
  return -(slope * 125 >> 2);
}

}  // namespace raspilot
