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
 * Only after a watchdog reset it holds who flew: any other reset, and the next one, find it
 * disarmed.
 *
 * optiboot clears MCUSR before it starts this program; then the marker tells of a watchdog reset,
 * which on_overflow() leaves when the loop stands still, and memory that is whole of any other.
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
