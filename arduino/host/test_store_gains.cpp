#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "store/gains.h"
#include "wire_floats.h"
#include "wire_vectors.h"

using namespace raspilot;

namespace {

typedef std::vector<uint8_t> Bytes;

Bytes wire_of(const Gains& gains) {
  Bytes wire(GAINS_SIZE);
  write_gains(gains, wire.data());
  return wire;
}

Bytes put(Bytes wire, size_t gain, float value) {
  put_f32(wire.data() + 4 * gain, value);
  return wire;
}

}  // namespace

TEST_CASE("the golden gains are read and written back as they are") {
  const auto payloads = payloads_of("g");
  REQUIRE_FALSE(payloads.empty());
  for (const Bytes& wire : payloads) {
    Gains gains = DEFAULT_GAINS;
    REQUIRE(read_gains(wire.data(), gains));
    CHECK(wire_of(gains) == wire);
  }
  Gains gains = DEFAULT_GAINS;
  REQUIRE(read_gains(payloads[0].data(), gains));
  CHECK(gains.rate[0].p == 2.1f);
  CHECK(gains.rate[1].d == 0.02f);
  CHECK(gains.rate[2].i == 0.3f);
  CHECK(gains.stabilize[0].p == 2.0f);
  CHECK(gains.stabilize[1].p == 4.1f);
  CHECK(gains.stabilize[2].p == 1.5f);
}

TEST_CASE("the gains at the first start are the defaults") {
  const float expected[18] = {2, 0, 0, 1.5f, 0, 0, 1, 0, 0, 8, 0, 0, 8, 0, 0, 0, 0, 0};
  Bytes wire(GAINS_SIZE);
  for (size_t gain = 0; gain < 18; ++gain) wire = put(wire, gain, expected[gain]);
  CHECK(wire_of(DEFAULT_GAINS) == wire);
}

TEST_CASE("a set with one gain outside 0 to 50 is refused as a whole") {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float wrong[] = {std::nextafter(MAX_GAIN, 51.0f), infinity, -infinity, nan, -nan,
                         -std::numeric_limits<float>::denorm_min(), -1.0f, 3e38f};
  const float right[] = {MAX_GAIN, 0.0f, -0.0f, std::numeric_limits<float>::denorm_min()};
  for (size_t gain = 0; gain < 18; ++gain) {
    for (float value : wrong) {
      CAPTURE(value);
      Gains gains = DEFAULT_GAINS;
      const Bytes wire = put(Bytes(GAINS_SIZE), gain, value);
      CHECK_FALSE(read_gains(wire.data(), gains));
      CHECK(wire_of(gains) == wire_of(DEFAULT_GAINS));
    }
    for (float value : right) {
      Gains gains = DEFAULT_GAINS;
      CHECK(read_gains(put(Bytes(GAINS_SIZE), gain, value).data(), gains));
    }
  }
}
