#include "mode_switch.h"

namespace raspilot {

namespace {

constexpr int16_t MIDDLE_US = 1300;
constexpr int16_t HIGH_US = 1700;
constexpr int16_t HYSTERESIS_US = 20;

}  // namespace

void ModeSwitch::take(Ticks pulse) {
  position_ = static_cast<uint8_t>(is_beyond(pulse, MIDDLE_US, 1) + is_beyond(pulse, HIGH_US, 2));
}

bool ModeSwitch::is_beyond(Ticks pulse, int16_t edge_us, uint8_t position_above) const {
  if (position_ == SWITCH_UNKNOWN) return pulse >= us_to_ticks(edge_us);
  const bool was_beyond = position_ >= position_above;
  const int16_t width_us = was_beyond ? -HYSTERESIS_US : HYSTERESIS_US;
  return pulse >= us_to_ticks(static_cast<int16_t>(edge_us + width_us));
}

}  // namespace raspilot
