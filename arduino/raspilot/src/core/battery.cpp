#include "battery.h"

namespace raspilot {

namespace {

constexpr uint16_t COUNTS = 1024;
constexpr uint8_t FILTER = 64;

}  // namespace

void Battery::on_count(uint16_t count) {
  const uint16_t level = level_;
  // The end of the range, 65536, is 0 in 16 bits.
  const uint16_t next = static_cast<uint16_t>(count + 1);
  level_ = static_cast<uint16_t>(level == 0 || next == COUNTS ? next * FILTER
                                                              : level + count - level / FILTER);
}

uint16_t Battery::mv(uint16_t full_scale_mv) const {
  return static_cast<uint16_t>(static_cast<uint32_t>(level_) * full_scale_mv >> 16);
}

bool Battery::calibrate(uint16_t mv, uint16_t& full_scale_mv) const {
  if (mv >= level_) return false;
  full_scale_mv = static_cast<uint16_t>((static_cast<uint32_t>(mv) << 16) / level_);
  return true;
}

}  // namespace raspilot
