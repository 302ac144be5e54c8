/** Writes checked frames (docs/protocols.md 2.1). */
#pragma once

#include <stdint.h>

namespace raspilot {

/** Gives `write` one byte after the other: the frame and its zero, size + 6 bytes. */
void write_frame(uint8_t sequence, char type, const uint8_t* payload, uint8_t size,
                 void (*write)(uint8_t byte));

}  // namespace raspilot
