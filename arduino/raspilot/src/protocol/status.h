/** The status message (docs/protocols.md 2.7). */
#pragma once

#include <stdint.h>

namespace raspilot {

class Autopilot;

/** Writes the STATUS_SIZE bytes of `x`. */
void write_status(const Autopilot& autopilot, uint32_t now_us, uint8_t* payload);

}  // namespace raspilot
