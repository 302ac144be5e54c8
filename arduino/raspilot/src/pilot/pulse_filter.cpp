#include "pulse_filter.h"

namespace raspilot {

namespace {

constexpr int16_t ONE_Q2 = 4;
constexpr int16_t BYPASS_Q2 = us_to_ticks(20) * ONE_Q2;
constexpr int16_t MOVING_Q2 = 3 * ONE_Q2;
constexpr int16_t HYSTERESIS_Q2 = 6;
constexpr Ticks UNCERTAIN_TICKS = us_to_ticks(4);

int16_t magnitude(int16_t value) { return value < 0 ? static_cast<int16_t>(-value) : value; }

}  // namespace

void PulseFilter::take(Ticks measured, bool is_uncertain) {
  if (is_uncertain && magnitude(static_cast<int16_t>(measured - pulse_)) <= UNCERTAIN_TICKS) {
    return;
  }
  const int16_t measured_q2 = static_cast<int16_t>(measured * ONE_Q2);
  const int16_t change_q2 = static_cast<int16_t>(measured_q2 - smoothed_q2_);
  const int16_t size_q2 = magnitude(change_q2);
  const int8_t direction = size_q2 < MOVING_Q2 ? 0 : change_q2 < 0 ? -1 : 1;
  if (size_q2 >= BYPASS_Q2 || (direction != 0 && direction == direction_)) {
    smoothed_q2_ = measured_q2;
  } else {
    // Division by 2 cuts towards zero on both sides: no bias (a shift would have one).
    smoothed_q2_ = static_cast<int16_t>(smoothed_q2_ + change_q2 / 2);
  }
  direction_ = direction;
  if (magnitude(static_cast<int16_t>(smoothed_q2_ - pulse_ * ONE_Q2)) > HYSTERESIS_Q2) {
    pulse_ = static_cast<Ticks>((smoothed_q2_ + ONE_Q2 / 2) / ONE_Q2);
  }
}

void PulseFilter::reset(Ticks pulse) {
  pulse_ = pulse;
  smoothed_q2_ = static_cast<int16_t>(pulse * ONE_Q2);
  direction_ = 0;
}

}  // namespace raspilot
