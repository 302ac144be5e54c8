/**
 * The course of time: the firmware runs on a separate stack until a moment, and stands still there
 * until the caller lets it run on. No wall clock is used.
 */
#pragma once

#include <stdint.h>

namespace host {

/** Of 62.5 ns, since the first power-on; they never stop, whatever resets the firmware. */
typedef int64_t Cycles;
constexpr Cycles PER_US = 16;
constexpr Cycles NEVER = INT64_MAX;

Cycles now();

/** Lets time pass for the firmware and the hardware. */
void pass(Cycles duration);
/** Leaves the firmware until the caller has given a sample. */
void await_sample();

enum Stop { REACHED = 0, WANTS_SAMPLE = 1 };

/** Runs to a moment, or to the next IMU sample that the caller must provide. */
Stop run_until(Cycles moment);

/** Bits of MCUSR. The firmware restarts 66 ms after this, when it runs next. */
void want_reset(uint8_t causes);
bool is_in_reset();

}  // namespace host
