/** CRC-16/CCITT-FALSE of checked frames (docs/protocols.md 2.1). */
#pragma once

#include <stdint.h>

namespace raspilot {

/** Takes bytes one by one; the register over a message and its big-endian CRC is 0. */
class Crc16 {
 public:
  void put(uint8_t byte) {
    // Byte-wise form of the polynomial 0x1021 in 8-bit steps, which are fast on an 8-bit CPU.
    uint8_t mixed = static_cast<uint8_t>(high_ ^ byte);
    mixed = static_cast<uint8_t>(mixed ^ (mixed >> 4));
    high_ = static_cast<uint8_t>(low_ ^ static_cast<uint8_t>(mixed << 4) ^ (mixed >> 3));
    low_ = static_cast<uint8_t>(static_cast<uint8_t>(mixed << 5) ^ mixed);
  }
  uint8_t high() const { return high_; }
  uint8_t low() const { return low_; }
  bool is_zero() const { return (high_ | low_) == 0; }

 private:
  uint8_t high_ = 0xFF;
  uint8_t low_ = 0xFF;
};

}  // namespace raspilot
