/** A PID controller in whole numbers that runs once a slot of 2000 us (thesis 2.3). */
#pragma once

#include <stdint.h>

#include "../store/gains.h"

namespace raspilot {

/**
 * Equal to simple-pid's with its own dt, within the rounding of its gains (P and I to 1 / 1024, D
 * to 1 / 16384 and at most 4) while the output is within its limits: derivative on the measurement,
 * here through a low-pass of 7 ms, and an integral that the limits stop. Here it does not grow
 * either while the output stands at the limit it pushes at.
 *
 * Inputs are 2^-F of a unit, outputs and limits 2^-(F + 10) of one: F is the caller's.
 */
class Pid {
 public:
  /** Takes gains in units per unit; the integral keeps its output, unless I is 0. */
  void tune(const PidGains& gains);
  /** Clears the state, which means nothing after a pause. */
  void reset();
  /** `limit` is at most 3e7: the integral and its greatest step fit in 32 bits. */
  int32_t update(int16_t error, int16_t measured, int32_t limit);

 private:
  int32_t derivative(int16_t measured);

  // Initialised to zero by the owner.
  int32_t integral_;  // 2^-6 of an output
  int16_t measured_;
  int16_t change_q4_;  // of the measurement a slot, after the low-pass
  uint16_t p_;
  uint16_t i_;
  uint16_t d_;
  bool has_measured_;
};

}  // namespace raspilot
