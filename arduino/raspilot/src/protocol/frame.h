/** Sizes of both framings (docs/protocols.md 2.1 and 2.2). */
#pragma once

#include <stdint.h>

namespace raspilot {

constexpr uint8_t LONGEST_PAYLOAD = 96;
/** Sequence, type, payload, CRC. */
constexpr uint8_t FRAME_OVERHEAD = 4;
constexpr uint8_t LONGEST_FRAME = LONGEST_PAYLOAD + FRAME_OVERHEAD;
/** The one byte that COBS adds, and the zero that ends a frame. */
constexpr uint8_t COBS_OVERHEAD = 2;
/** What is unfinished for so long after its first byte is dropped. */
constexpr uint32_t UNFINISHED_US = 100000;

/** The bytes of the message being received; both framings use it, never at the same time. */
struct ReceiveBuffer {
  uint8_t bytes[LONGEST_FRAME];
};

}  // namespace raspilot
