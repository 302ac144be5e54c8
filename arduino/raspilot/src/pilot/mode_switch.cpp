#include "mode_switch.h"

namespace raspilot {

namespace {

constexpr Ticks MIDDLE = us_to_ticks(1300);
constexpr Ticks HIGH = us_to_ticks(1700);
constexpr Ticks HYSTERESIS = us_to_ticks(20);

}  // namespace

void ModeSwitch::update(Ticks pulse) {
  Ticks middle = MIDDLE;
  Ticks high = HIGH;
  if (position_ == 0) middle += HYSTERESIS;
  if (position_ == 1) {
    middle -= HYSTERESIS;
    high += HYSTERESIS;
  }
  if (position_ == 2) high -= HYSTERESIS;
  position_ = static_cast<uint8_t>((pulse >= middle) + (pulse >= high));
}

}  // namespace raspilot
