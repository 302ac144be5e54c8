#include <doctest/doctest.h>

#include <cstring>

#include "frame_bytes.h"
#include "wire_floats.h"

using namespace raspilot;

namespace {

uint32_t bits_of(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

typedef FrameWriter<put_written> Frame;

/** As it stands in a frame that nothing else is in: behind the first code, sequence and type. */
uint32_t written(void (*write)(int16_t), int16_t value) {
  Frame::begin(1, 'O');
  write(value);
  const uint8_t count = Frame::finish();
  CobsDecoder decoder;
  std::vector<uint8_t> plain;
  for (uint8_t at = 0; at + 1 < count; ++at) {
    uint8_t byte;
    if (decoder.receive(written_frame()[at], byte) == CobsDecoder::Step::BYTE) plain.push_back(byte);
  }
  return u32_at(plain.data() + 2);
}

}  // namespace

TEST_CASE("units are sent as the single that the division gives, to the last bit") {
  for (int32_t value = -32768; value <= 32767; ++value) {
    const int16_t units = static_cast<int16_t>(value);
    const float number = units;
    REQUIRE(written(Frame::hundredths, units) == bits_of(number / 100.0f));
    REQUIRE(written(Frame::sixteenths, units) == bits_of(number / 16.0f));
  }
}
