/** The receiver's edges: interrupts stamp them, the loop hands them on (thesis 4.4.4). */
#pragma once

#include "../pilot/pwm_reader.h"

namespace raspilot {
namespace edges {

/** Sets the six inputs up, with pull-ups, so that a broken wire is silence. */
void begin();

/**
 * Passes the stamped edges to the reader. A full ring stops the interrupts until here, so that
 * noise takes at most 18 of them each slot.
 */
void drain(PwmReader& receiver, uint32_t now_us);

}  // namespace edges
}  // namespace raspilot
