#include "wire_bytes.h"

#include <string.h>

namespace raspilot {

uint16_t WireReader::u16() {
  const uint8_t high = u8();
  return static_cast<uint16_t>(high << 8 | u8());
}

uint32_t WireReader::u32() {
  const uint32_t high = u16();
  return high << 16 | u16();
}

float WireReader::f32() {
  const uint32_t bits = u32();
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
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

}  // namespace raspilot
