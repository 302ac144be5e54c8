/** Singles on the wire, as docs/protocols.md 2 has them: big-endian. */
#pragma once

#include <stdint.h>
#include <string.h>

namespace raspilot {

inline uint32_t u32_at(const uint8_t* wire) {
  return static_cast<uint32_t>(wire[0]) << 24 | static_cast<uint32_t>(wire[1]) << 16 |
         static_cast<uint32_t>(wire[2]) << 8 | wire[3];
}

inline float f32_at(const uint8_t* wire) {
  const uint32_t bits = u32_at(wire);
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

inline void put_f32(uint8_t* wire, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  for (int at = 0; at < 4; ++at) wire[at] = static_cast<uint8_t>(bits >> (24 - 8 * at));
}

}  // namespace raspilot
