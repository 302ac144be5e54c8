/** The time: Timer1 running freely at 2 MHz, extended by its overflows (data sheet 16). */
#pragma once

#include <stdint.h>

namespace raspilot {
namespace clock {

/**
 * Starts Timer1 and Timer2 in normal mode with prescaler 8, at the same cycle: Timer2 is the low
 * byte of Timer1 from then on.
 */
void begin();

/** Microseconds since begin(), wraps after 71.6 minutes. */
uint32_t now_us();

/** Timer1, in half microseconds; wraps after 32.768 ms. */
uint16_t ticks();

}  // namespace clock
}  // namespace raspilot
