/** The bytes of a checked frame as the firmware writes them. */
#pragma once

#include <stdint.h>

#include <vector>

#include "protocol/frame.h"

namespace raspilot {

inline std::vector<uint8_t> frame_bytes(uint8_t sequence, char type, const uint8_t* payload,
                                        uint8_t size) {
  static uint8_t wire[256];
  const uint8_t count = write_frame(sequence, type, payload, size,
                                    [](uint8_t at, uint8_t byte) { wire[at] = byte; });
  return std::vector<uint8_t>(wire, wire + count);
}

}  // namespace raspilot
