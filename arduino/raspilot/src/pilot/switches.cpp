#include "switches.h"

namespace raspilot {

namespace {

constexpr Ticks MODE_MIDDLE = us_to_ticks(1300);
constexpr Ticks MODE_HIGH = us_to_ticks(1700);
constexpr Ticks MODE_HYSTERESIS = us_to_ticks(20);

constexpr int16_t ARMING_MIDDLE_US = 1500;
constexpr int16_t ARMING_HYSTERESIS_US = 20;
constexpr uint16_t DEBOUNCE_UNITS = units_at_least(300);

}  // namespace

void ModeSwitch::update(Ticks pulse) {
  Ticks middle = MODE_MIDDLE;
  Ticks high = MODE_HIGH;
  if (position_ == 0) middle += MODE_HYSTERESIS;
  if (position_ == 1) {
    middle -= MODE_HYSTERESIS;
    high += MODE_HYSTERESIS;
  }
  if (position_ == 2) high -= MODE_HYSTERESIS;
  position_ = static_cast<uint8_t>((pulse >= middle) + (pulse >= high));
}

ArmingSwitch::Event ArmingSwitch::update(Ticks pulse, uint16_t passed_units) {
  const int16_t width_us =
      now_ == HIGH ? -ARMING_HYSTERESIS_US : now_ == LOW ? ARMING_HYSTERESIS_US : 0;
  const Level level =
      pulse >= us_to_ticks(static_cast<int16_t>(ARMING_MIDDLE_US + width_us)) ? HIGH : LOW;
  if (level != now_) {
    now_ = level;
    since_.start();
    return NOTHING;
  }
  since_.pass(passed_units);
  if (settled_ == now_ || since_.units() < DEBOUNCE_UNITS) return NOTHING;
  const bool was_low = settled_ == LOW;
  settled_ = now_;
  if (now_ == LOW) return FELL;
  return was_low ? ROSE : NOTHING;
}

void ArmingSwitch::reset() { now_ = settled_ = UNKNOWN; }

}  // namespace raspilot
