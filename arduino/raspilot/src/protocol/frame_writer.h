/** Writes a checked frame field by field, encoded, as far as it has come (docs/protocols.md 2.1). */
#pragma once

#include <stdint.h>
#include <string.h>

#include "../core/compiler.h"
#include "cobs.h"
#include "crc16.h"

namespace raspilot {

/**
 * `PUT` takes each byte with its place; some places twice, the second byte counts. There is one
 * frame at a time for each `PUT`: a call that names no object takes the chip four bytes less.
 */
template <void (*PUT)(uint8_t at, uint8_t byte)>
class FrameWriter {
 public:
  static void begin(uint8_t sequence, char type) {
    cobs_.begin();
    crc_ = Crc16();
    u8(sequence);
    u8(static_cast<uint8_t>(type));
  }
  OUT_OF_LINE static void u8(uint8_t byte) {
    cobs_.put(byte);
    crc_.put(byte);
  }
  OUT_OF_LINE static void u16(uint16_t value) {
    u8(static_cast<uint8_t>(value >> 8));
    u8(static_cast<uint8_t>(value));
  }
  /** `value` / 100 and `value` / 16 as the nearest single. */
  OUT_OF_LINE static void hundredths(int16_t value) { ratio(value, 100.0F); }
  OUT_OF_LINE static void sixteenths(int16_t value) { ratio(value, 16.0F); }
  /** Ends the frame; returns the count of its bytes, 6 more than those of the payload. */
  static uint8_t finish() {
    // The second half of the CRC is that of the register before its first half went in.
    u8(crc_.high());
    u8(crc_.high());
    const uint8_t end = cobs_.finish();
    PUT(end, 0);
    return static_cast<uint8_t>(end + 1);
  }

 private:
  OUT_OF_LINE static void ratio(int16_t value, float unit) {
    const float number = value / unit;
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    u16(static_cast<uint16_t>(bits >> 16));
    u16(static_cast<uint16_t>(bits));
  }

  static CobsEncoder<PUT> cobs_;
  static Crc16 crc_;
};

template <void (*PUT)(uint8_t at, uint8_t byte)>
CobsEncoder<PUT> FrameWriter<PUT>::cobs_;
template <void (*PUT)(uint8_t at, uint8_t byte)>
Crc16 FrameWriter<PUT>::crc_;

}  // namespace raspilot
