#include "pulse_filter.h"

namespace raspilot {

namespace {

constexpr Ticks CENTRE = us_to_ticks(1500);
constexpr int16_t ONE_8 = 8;
constexpr int16_t BYPASS_8 = us_to_ticks(20) * ONE_8;
constexpr int16_t REVERSAL_8 = us_to_ticks(3) * ONE_8;
constexpr int16_t MOVING_8 = 3 * ONE_8;
constexpr int16_t PLAY_8 = 6;
constexpr int16_t UNCERTAIN_8 = us_to_ticks(4) * ONE_8;
constexpr int8_t JUST_MOVED = 2;

int16_t to_8(Ticks pulse) { return static_cast<int16_t>((pulse - CENTRE) * ONE_8); }
int16_t magnitude(int16_t value) { return value < 0 ? static_cast<int16_t>(-value) : value; }

}  // namespace

void PulseFilter::take(Ticks measured, bool is_uncertain) {
  const int16_t measured_8 = to_8(measured);
  const int16_t shown_8 = to_8(pulse_);
  const int16_t off_8 = static_cast<int16_t>(measured_8 - shown_8);
  if (is_uncertain && magnitude(off_8) <= UNCERTAIN_8) return;
  const int16_t change_8 = static_cast<int16_t>(measured_8 - smoothed_8_);
  const int16_t size_8 = magnitude(change_8);
  const int8_t movement = movement_;
  int8_t direction = 0;
  if (size_8 >= MOVING_8) direction = change_8 < 0 ? -JUST_MOVED : JUST_MOVED;
  const bool goes_on = direction != 0 && movement != 0 && (direction < 0) == (movement < 0);
  const bool turns_back = movement != 0 && size_8 >= REVERSAL_8;
  if (size_8 >= BYPASS_8 || goes_on || turns_back) {
    reset(measured);
  } else {
    // Division cuts towards zero on both sides: no bias, which a shift would have.
    smoothed_8_ = static_cast<int16_t>(smoothed_8_ + change_8 / 2);
    const int16_t ahead_8 = static_cast<int16_t>(smoothed_8_ - shown_8);
    const int16_t step = static_cast<int16_t>((magnitude(ahead_8) + ONE_8 - 1 - PLAY_8) / ONE_8);
    pulse_ = static_cast<Ticks>(ahead_8 < 0 ? pulse_ - step : pulse_ + step);
  }
  movement_ = direction != 0 ? direction : static_cast<int8_t>(movement / 2);
}

void PulseFilter::reset(Ticks pulse) {
  pulse_ = pulse;
  smoothed_8_ = to_8(pulse);
  movement_ = 0;
}

}  // namespace raspilot
