/** The status message (docs/protocols.md 2.7). */
#pragma once

#include <stdint.h>

namespace raspilot {

class Autopilot;

/** Writes the STATUS_SIZE bytes of `x` into the frame that has begun. */
void write_status(const Autopilot& autopilot, uint32_t now_us);

}  // namespace raspilot
