#include <doctest/doctest.h>
#include <stddef.h>

#include <vector>

#include "store/calibration.h"
#include "store/wire_bytes.h"

using namespace raspilot;

namespace {

typedef std::vector<uint8_t> Bytes;

Bytes bytes_of(const Calibration& calibration) {
  Bytes bytes(CALIBRATION_SIZE);
  write_calibration(calibration, bytes.data());
  return bytes;
}

/** Whether a word of the default calibration may become `value`; then it reads back the same. */
bool is_taken(size_t word, int value) {
  Bytes bytes = bytes_of(DEFAULT_CALIBRATION);
  WireWriter(bytes.data() + 2 * word).i16(static_cast<int16_t>(value));
  Calibration calibration = DEFAULT_CALIBRATION;
  const bool is_right = read_calibration(bytes.data(), calibration);
  CHECK(bytes_of(calibration) == (is_right ? bytes : bytes_of(DEFAULT_CALIBRATION)));
  return is_right;
}

void check_word(size_t word, int least, int most) {
  CAPTURE(word);
  CHECK(is_taken(word, least));
  CHECK(is_taken(word, most));
  CHECK_FALSE(is_taken(word, least - 1));
  CHECK_FALSE(is_taken(word, most + 1));
}

}  // namespace

TEST_CASE("a calibration comes back from its bytes, each value in its place") {
  Calibration calibration = DEFAULT_CALIBRATION;
  calibration.gyro_bias_16[0] = -640;
  calibration.gyro_bias_16[2] = 17;
  calibration.level_roll_cdeg = 250;
  calibration.level_pitch_cdeg = -3000;
  calibration.receiver[AUX2] = ChannelRange{885, 1234, 2115};
  Calibration read = DEFAULT_CALIBRATION;
  REQUIRE(read_calibration(bytes_of(calibration).data(), read));
  CHECK(read.gyro_bias_16[0] == -640);
  CHECK(read.gyro_bias_16[1] == 0);
  CHECK(read.gyro_bias_16[2] == 17);
  CHECK(read.level_roll_cdeg == 250);
  CHECK(read.level_pitch_cdeg == -3000);
  CHECK(read.receiver[AUX2].lowest_us == 885);
  CHECK(read.receiver[AUX2].centre_us == 1234);
  CHECK(read.receiver[AUX2].highest_us == 2115);
  CHECK(read.receiver[AILERONS].lowest_us == 1000);
}

TEST_CASE("a calibration with one value out of range is refused whole") {
  for (size_t axis = 0; axis < 3; ++axis) check_word(axis, -640, 640);
  check_word(3, -3000, 3000);
  check_word(4, -3000, 3000);
  for (size_t channel = 0; channel < INPUTS; ++channel) {
    const size_t first = 5 + 3 * channel;
    check_word(first, 800, 1400);
    check_word(first + 1, 1100, 1900);
    check_word(first + 2, 1600, 2200);
  }
}
