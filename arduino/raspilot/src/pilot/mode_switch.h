/** The pilot's AUX1 switch: which of its three positions, with hysteresis. */
#pragma once

#include "../core/types.h"

namespace raspilot {

/** No position is known before the first pulse. */
constexpr uint8_t SWITCH_UNKNOWN = 255;

class ModeSwitch {
 public:
  /** 0 low, 1 middle, 2 high, SWITCH_UNKNOWN before the first pulse. */
  uint8_t position() const { return position_; }
  /** Follows the pulse immediately; moves at 1300 and 1700 us, each way 20 us beyond them. */
  void update(Ticks pulse);
  void restore(uint8_t position) { position_ = position <= 2 ? position : SWITCH_UNKNOWN; }

 private:
  uint8_t position_ = SWITCH_UNKNOWN;
};

}  // namespace raspilot
