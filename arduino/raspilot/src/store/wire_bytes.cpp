#include "wire_bytes.h"

#include <string.h>

namespace raspilot {

namespace {

constexpr uint32_t SIGN = 0x80000000;
constexpr uint32_t IMPLIED_ONE = 0x80000000;
constexpr uint8_t MANTISSA_BITS = 23;
// What a unit is of 2^-32, and still to be halved six times or three.
constexpr uint32_t HUNDREDTH = 0xA3D70A3D;
constexpr uint32_t SIXTEENTH = 0x80000000;
constexpr uint8_t EXPONENT_BIAS = 127;

}  // namespace

uint16_t WireReader::u16() {
  const uint8_t high = u8();
  return static_cast<uint16_t>(high << 8 | u8());
}

uint32_t WireReader::u32() {
  const uint32_t high = u16();
  return high << 16 | u16();
}

bool is_magnitude_within(uint32_t bits, uint32_t most_bits) {
  return (bits & ~SIGN) <= most_bits;
}

void WireWriter::u16(uint16_t value) {
  u8(static_cast<uint8_t>(value >> 8));
  u8(static_cast<uint8_t>(value));
}

void WireWriter::u32(uint32_t value) {
  u16(static_cast<uint16_t>(value >> 16));
  u16(static_cast<uint16_t>(value));
}

void WireWriter::f32(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  u32(bits);
}

void WireWriter::hundredths(int16_t value) { fraction(value, HUNDREDTH, 6); }

void WireWriter::sixteenths(int16_t value) { fraction(value, SIXTEENTH, 3); }

OUT_OF_LINE void WireWriter::fraction(int16_t value, uint32_t unit, uint8_t halvings) {
  uint16_t magnitude = static_cast<uint16_t>(value < 0 ? -value : value);
  uint32_t bits = 0;
  if (magnitude != 0) {
    uint8_t exponent = static_cast<uint8_t>(EXPONENT_BIAS + 15 - halvings);
    for (; magnitude < 0x8000; magnitude = static_cast<uint16_t>(magnitude << 1)) --exponent;
    // Two products of 16 bits: the library's division of 32 bits takes ten times as long.
    const uint32_t low = static_cast<uint32_t>(magnitude) * static_cast<uint16_t>(unit);
    const uint32_t high =
        static_cast<uint32_t>(magnitude) * static_cast<uint16_t>(unit >> 16);
    uint32_t mantissa = high + (low >> 16);
    if (mantissa < IMPLIED_ONE) {
      mantissa <<= 1;
      --exponent;
    }
    // The implied one adds 1 to the exponent, and so does a mantissa that is rounded up to 2.
    bits = (static_cast<uint32_t>(exponent - 1) << MANTISSA_BITS) + (mantissa >> 8) +
           (static_cast<uint8_t>(mantissa) >> 7);
  }
  u32(value < 0 ? bits | SIGN : bits);
}

}  // namespace raspilot
