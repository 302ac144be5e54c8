#include "battery.h"

namespace raspilot {

namespace {

constexpr uint16_t SATURATED = 1023;
constexpr uint8_t FILTER = 64;

}  // namespace

OUT_OF_LINE void Battery::on_count(uint16_t count) {
  uint16_t level = level_;
  if (level == 0) level = static_cast<uint16_t>(count * FILTER);
  level = static_cast<uint16_t>(level + count - level / FILTER);
  if (count == SATURATED) level = 0;
  level_ = level;
}

uint16_t Battery::mv(uint16_t full_scale_mv) const {
  return static_cast<uint16_t>(static_cast<uint32_t>(level_) * full_scale_mv >> 16);
}

uint16_t Battery::full_scale_mv(uint16_t mv) const {
  return mv < level_ ? static_cast<uint16_t>((static_cast<uint32_t>(mv) << 16) / level_) : 0;
}

}  // namespace raspilot
