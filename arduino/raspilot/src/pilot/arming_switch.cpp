#include "arming_switch.h"

namespace raspilot {

namespace {

constexpr int16_t MIDDLE_US = 1500;
constexpr int16_t HYSTERESIS_US = 20;
constexpr uint16_t DEBOUNCE_UNITS = units_at_least(300);

}  // namespace

ArmingSwitch::Event ArmingSwitch::update(Ticks pulse, uint16_t passed_units) {
  const int16_t width_us = now_ == HIGH ? -HYSTERESIS_US : now_ == LOW ? HYSTERESIS_US : 0;
  const Level level =
      pulse >= us_to_ticks(static_cast<int16_t>(MIDDLE_US + width_us)) ? HIGH : LOW;
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
