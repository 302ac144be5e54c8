/** The thesis's low-pass with its bypass (thesis 4.4.4), for one channel, in ticks. */
#pragma once

#include "../core/types.h"

namespace raspilot {

/**
 * Still sticks give a still output, moving ones pass unchanged.
 *
 * y += (x - y) / 2. A change of 20 us or more bypasses it (thesis 4.4.4), and so does a second
 * change of 1.5 us or more in the same direction: noise turns back, a stick does not. The output
 * follows y when that is more than 1.5 ticks away.
 */
class PulseFilter {
 public:
  /** Takes a measured pulse; one whose stamps are uncertain only moves it by more than 4 us. */
  void take(Ticks measured, bool is_uncertain);
  /** Goes to a pulse as if there had been no other. */
  void reset(Ticks pulse);
  Ticks pulse() const { return pulse_; }

 private:
  int16_t smoothed_q2_ = us_to_ticks(1500) * 4;
  Ticks pulse_ = us_to_ticks(1500);
  int8_t direction_ = 0;
};

}  // namespace raspilot
