#include "wire_bytes.h"

#include <string.h>

namespace raspilot {

OUT_OF_LINE void WireWriter::u16(uint16_t value) {
  u8(static_cast<uint8_t>(value >> 8));
  u8(static_cast<uint8_t>(value));
}

OUT_OF_LINE void WireWriter::ratio(int16_t value, float unit) {
  const float number = value / unit;
  uint32_t bits;
  memcpy(&bits, &number, sizeof bits);
  u16(static_cast<uint16_t>(bits >> 16));
  u16(static_cast<uint16_t>(bits));
}

OUT_OF_LINE void WireWriter::hundredths(int16_t value) { ratio(value, 100.0F); }

OUT_OF_LINE void WireWriter::sixteenths(int16_t value) { ratio(value, 16.0F); }

}  // namespace raspilot
