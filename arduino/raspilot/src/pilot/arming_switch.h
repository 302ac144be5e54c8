/** The pilot's AUX2 switch: debounced, and its edge from low to high, which arms. */
#pragma once

#include "../core/compiler.h"
#include "../core/types.h"
#include "lifetime.h"

namespace raspilot {

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
