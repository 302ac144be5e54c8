/**
 * A conversation with the serial line out of arbitrary bytes, and its invariants. The fuzzer
 * generates scripts; the host tests replay the kept ones.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace raspilot {

/** Result of a script. */
struct ScriptEnd {
  bool is_armed;
};

/**
 * Plays one script on an aircraft that only an Arm Command can arm. Its records are: 0x00 to 0x7F,
 * this number of raw bytes; 0x80 to 0xBF, the low six bits plus one slots of 2 ms; 0xC0 to 0xFF, a
 * checked frame of the type and payload that follow, valid after any bytes before. Aborts when one
 * of the rules is broken.
 */
ScriptEnd play(const uint8_t* script, size_t size);

}  // namespace raspilot
