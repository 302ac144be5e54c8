#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>

#include "store/wire_bytes.h"

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
  return WireReader(bytes).u32();
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

TEST_CASE("a single is within its limit on both sides, and NaN and infinity never are") {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const uint32_t most = bits_of(90.0f);
  for (const float right : {0.0f, -0.0f, 90.0f, -90.0f, 1e-40f}) {
    CHECK(is_magnitude_within(bits_of(right), most));
  }
  for (const float wrong : {std::nextafter(90.0f, 91.0f), std::nextafter(-90.0f, -91.0f), infinity,
                            -infinity, nan, -nan}) {
    CHECK_FALSE(is_magnitude_within(bits_of(wrong), most));
  }
}
