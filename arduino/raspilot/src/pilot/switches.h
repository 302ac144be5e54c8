/** The pilot's switches: the mode on AUX1, arming on AUX2. */
#pragma once

#include "../core/compiler.h"
#include "../core/types.h"
#include "lifetime.h"

namespace raspilot {

/** No position is known before the first pulse. */
constexpr uint8_t SWITCH_UNKNOWN = 255;

/** AUX1: which of its three positions, with hysteresis. */
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

/** AUX2: debounced, and its edge from low to high, which arms. */
class ArmingSwitch {
 public:
  enum Event : uint8_t { NOTHING, ROSE, FELL };

  /**
   * Takes the pulse of a valid receiver; `passed_units` (lifetime.h) since the last one. A position
   * counts after 300 ms. ROSE needs a low that counted before it; the initial position is not an
   * edge.
   */
  Event update(Ticks pulse, uint16_t passed_units);
  /** The receiver is lost: its later pulses start from the beginning. */
  void reset();
  /** At high, and has been for 300 ms. */
  bool is_high() const { return settled_ == HIGH && now_ == HIGH; }

 private:
  enum Level : uint8_t { UNKNOWN, LOW, HIGH };

  Stopwatch since_;
  Level now_ ZEROED;
  Level settled_ ZEROED;
};

}  // namespace raspilot
