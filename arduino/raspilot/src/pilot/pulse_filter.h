/** The thesis's low-pass with its bypass (thesis 4.4.4), for one channel, in ticks. */
#pragma once

#include "../core/compiler.h"
#include "../core/types.h"

namespace raspilot {

/**
 * Still sticks give a still output, moving ones pass unchanged.
 *
 * y += (x - y) / 2. A change of 20 us or more bypasses it (thesis 4.4.4). So does one that soon
 * follows another of at least 1.5 us, when it continues in its direction or reverses by 3 us: noise
 * does neither, a stick does. The output follows y with a play of 3/8 us, like a gear.
 */
class PulseFilter {
 public:
  /** Takes a measured pulse; one whose stamps are uncertain only moves it by more than 6 us. */
  void update(Ticks measured, bool is_uncertain);
  /** Jumps to a pulse, as if there had been no other; call it first. */
  void reset(Ticks pulse);
  Ticks pulse() const { return pulse_; }

 private:
  Ticks pulse_ ZEROED;
  /** y less the output, in eighths of a tick. */
  int8_t ahead_8_ ZEROED;
  /** Sign: where it moved last; 2 in this pulse, 1 in the one before, 0 earlier. */
  int8_t movement_ ZEROED;
};

}  // namespace raspilot
