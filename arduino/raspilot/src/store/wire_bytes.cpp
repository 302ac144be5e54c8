#include "wire_bytes.h"

#include <string.h>

namespace raspilot {

namespace {

constexpr uint32_t SIGN = 0x80000000;

}  // namespace

OUT_OF_LINE uint16_t WireReader::u16() {
  const uint8_t high = u8();
  return static_cast<uint16_t>(high << 8 | u8());
}

OUT_OF_LINE uint32_t WireReader::u32() {
  const uint32_t high = u16();
  return high << 16 | u16();
}

bool is_magnitude_within(uint32_t bits, uint32_t most_bits) {
  return (bits & ~SIGN) <= most_bits;
}

OUT_OF_LINE void WireWriter::u16(uint16_t value) {
  u8(static_cast<uint8_t>(value >> 8));
  u8(static_cast<uint8_t>(value));
}

OUT_OF_LINE void WireWriter::u32(uint32_t value) {
  u16(static_cast<uint16_t>(value >> 16));
  u16(static_cast<uint16_t>(value));
}

OUT_OF_LINE void WireWriter::f32(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  u32(bits);
}

OUT_OF_LINE void WireWriter::hundredths(int16_t value) { f32(value / 100.0F); }

OUT_OF_LINE void WireWriter::sixteenths(int16_t value) { f32(value / 16.0F); }

}  // namespace raspilot
