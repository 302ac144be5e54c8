/** The watchdog, why the chip was reset, and the memory that outlives it. */
#pragma once

#include <stdint.h>

#include "../store/saved_state.h"

namespace raspilot {
namespace reset {

/** Cause bits as the status shows them (Autopilot's ResetCause), 0 when a bootloader hid them. */
uint8_t cause();

/**
 * The state to fly on with, into `state`; false unless this was a watchdog reset. Power-on and
 * brown-out make the kept copies unreadable.
 *
 * optiboot clears MCUSR before it starts this program; then the marker tells, which on_overflow()
 * leaves when the loop stands still.
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
