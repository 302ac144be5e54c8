#include <doctest/doctest.h>

#include <cstring>

#include "store/wire_bytes.h"
#include "wire_floats.h"

using namespace raspilot;

namespace {

uint32_t bits_of(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

uint32_t written(void (WireWriter::*write)(int16_t), int16_t value) {
  uint8_t bytes[4];
  WireWriter writer(bytes);
  (writer.*write)(value);
  return u32_at(bytes);
}

}  // namespace

TEST_CASE("units are sent as the single that the division gives, to the last bit") {
  for (int32_t value = -32768; value <= 32767; ++value) {
    const int16_t units = static_cast<int16_t>(value);
    const float number = units;
    REQUIRE(written(&WireWriter::hundredths, units) == bits_of(number / 100.0f));
    REQUIRE(written(&WireWriter::sixteenths, units) == bits_of(number / 16.0f));
  }
}
