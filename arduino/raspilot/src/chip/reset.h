/** The watchdog, why the chip was reset, and the memory that outlives it. */
#pragma once

#include <stdint.h>

#include "../store/saved_state.h"

namespace raspilot {
namespace reset {

/** Cause bits as the status shows them (Autopilot's ResetCause), 0 when a bootloader hid them. */
uint8_t cause();

/**
 * The state from before the reset, into `state`; false after power-on, and when memory lost it.
 * Only after a watchdog reset it holds the flying authority: any other reset, and the next one,
 * find it disarmed.
 *
 * optiboot clears MCUSR before it starts this program; then a watchdog reset is recognised by the
 * marker that on_overflow() leaves when the loop stands still, any other by intact memory.
 */
bool restore(SavedState& state);

/** Keeps the state for the case of a watchdog reset. */
void keep(const SavedState& state);

/** The loop has finished a slot; the watchdog bites 120 ms after the last. */
void feed();

/** Each 32.768 ms, by Timer1's interrupt. */
void on_overflow();

}  // namespace reset
}  // namespace raspilot
