/** Big-endian numbers one after another, as the wire and EEPROM hold them. */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"

namespace raspilot {

/** Reads on from `bytes`; the caller knows that enough are there. */
class WireReader {
 public:
  explicit WireReader(const uint8_t* bytes) : next_(bytes) {}

  uint8_t u8() { return *next_++; }
  uint16_t u16() {
    const uint8_t high = u8();
    return static_cast<uint16_t>(high << 8 | u8());
  }
  int16_t i16() { return static_cast<int16_t>(u16()); }

 private:
  const uint8_t* next_;
};

/** Writes on from `bytes`; the caller knows that there is room. */
class WireWriter {
 public:
  explicit WireWriter(uint8_t* bytes) : next_(bytes) {}

  void u8(uint8_t value) { *next_++ = value; }
  void u16(uint16_t value) {
    u8(static_cast<uint8_t>(value >> 8));
    u8(static_cast<uint8_t>(value));
  }
  void i16(int16_t value) { u16(static_cast<uint16_t>(value)); }

 private:
  uint8_t* next_;
};

}  // namespace raspilot
