#include "battery.h"

namespace raspilot {

namespace {

constexpr uint8_t FILTER = 64;
/** The ADC's last count: the voltage is this one or any above. */
constexpr uint16_t SATURATED = 1023 * FILTER;

}  // namespace

void Battery::on_count(uint16_t count) {
  if (level_ == 0) level_ = static_cast<uint16_t>(count * FILTER);
  level_ = static_cast<uint16_t>(level_ + count - level_ / FILTER);
}

bool Battery::is_saturated() const { return level_ >= SATURATED; }

uint16_t Battery::mv(uint16_t full_scale_mv) const {
  if (is_saturated()) return 0;
  return static_cast<uint16_t>(static_cast<uint32_t>(level_) * full_scale_mv >> 16);
}

Reason Battery::calibrate(uint16_t mv, uint16_t& full_scale_mv) const {
  // A pin so low that the full scale would have more than 16 bits is not a battery's.
  if (mv != 0 && (mv >= level_ || is_saturated())) return Reason::BATTERY_NOT_MEASURED;
  full_scale_mv = static_cast<uint16_t>((static_cast<uint32_t>(mv) << 16) / (level_ | 1));
  return Reason::NONE;
}

}  // namespace raspilot
