#include "pulse_filter.h"

namespace raspilot {

namespace {

constexpr int16_t ONE_8 = 8;
constexpr Ticks BYPASS = us_to_ticks(20);
constexpr Ticks UNCERTAIN = us_to_ticks(6);
constexpr int16_t REVERSAL_8 = us_to_ticks(3) * ONE_8;
constexpr int16_t MOVING_8 = 3 * ONE_8;
constexpr int8_t PLAY_8 = 6;
constexpr int8_t JUST_MOVED = 2;

int16_t magnitude(int16_t value) { return value < 0 ? static_cast<int16_t>(-value) : value; }

}  // namespace

void PulseFilter::update(Ticks measured, bool is_uncertain) {
  const int8_t movement = movement_;
  const Ticks off = static_cast<Ticks>(measured - pulse_);
  if (is_uncertain && magnitude(off) <= UNCERTAIN) return;
  if (magnitude(off) >= BYPASS) {
    reset(measured);
    movement_ = off < 0 ? -JUST_MOVED : JUST_MOVED;
    return;
  }
  const int16_t change_8 = static_cast<int16_t>(off * ONE_8 - ahead_8_);
  const int16_t size_8 = magnitude(change_8);
  int8_t direction = 0;
  if (size_8 >= MOVING_8) direction = change_8 < 0 ? -JUST_MOVED : JUST_MOVED;
  movement_ = direction != 0 ? direction : static_cast<int8_t>(movement / 2);
  const bool goes_on = direction != 0 && (direction < 0) == (movement < 0);
  if (movement != 0 && (goes_on || size_8 >= REVERSAL_8)) {
    pulse_ = measured;
    ahead_8_ = 0;
    return;
  }
  // Division cuts towards zero on both sides: no bias, which a shift would have.
  int16_t ahead_8 = static_cast<int16_t>(ahead_8_ + change_8 / 2);
  for (; ahead_8 > PLAY_8; ahead_8 = static_cast<int16_t>(ahead_8 - ONE_8)) ++pulse_;
  for (; ahead_8 < -PLAY_8; ahead_8 = static_cast<int16_t>(ahead_8 + ONE_8)) --pulse_;
  ahead_8_ = static_cast<int8_t>(ahead_8);
}

void PulseFilter::reset(Ticks pulse) {
  pulse_ = pulse;
  ahead_8_ = movement_ = 0;
}

}  // namespace raspilot
