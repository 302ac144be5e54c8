/** The bytes of a checked frame as the firmware writes them. */
#pragma once

#include <stdint.h>

#include <vector>

#include "protocol/frame_writer.h"

namespace raspilot {

inline uint8_t* written_frame() {
  static uint8_t wire[256];
  return wire;
}

inline void put_written(uint8_t at, uint8_t byte) { written_frame()[at] = byte; }

inline std::vector<uint8_t> frame_bytes(uint8_t sequence, char type, const uint8_t* payload,
                                        uint8_t size) {
  typedef FrameWriter<put_written> Frame;
  Frame::begin(sequence, type);
  for (uint8_t at = 0; at < size; ++at) Frame::u8(payload[at]);
  const uint8_t count = Frame::finish();
  return std::vector<uint8_t>(written_frame(), written_frame() + count);
}

}  // namespace raspilot
