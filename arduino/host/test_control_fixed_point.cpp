#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "control/fixed_point.h"

using namespace raspilot;

namespace {

constexpr int STEP = 251;

int within(int value) { return std::max(-32767, std::min(32767, value)); }

}  // namespace

TEST_CASE("sums and differences stay within 16 bits") {
  for (int a = -32768; a <= 32767; a += STEP) {
    for (int b = -32768; b <= 32767; b += STEP) {
      const int16_t first = static_cast<int16_t>(a);
      const int16_t second = static_cast<int16_t>(b);
      CHECK(sum_of(first, second) == within(a + b));
      CHECK(difference_of(first, second) == within(a - b));
    }
  }
  CHECK(negative(-32768) == 32767);
  CHECK(sum_of(-16384, -16384) == -32767);
}

TEST_CASE("products with fractions are rounded to the nearest") {
  for (int a = -32767; a <= 32767; a += STEP) {
    for (int b = -16384; b <= 16384; b += STEP) {
      const int16_t first = static_cast<int16_t>(a);
      const int16_t second = static_cast<int16_t>(b);
      CHECK(times_q14(first, second) == std::floor(a * b / 16384.0 + 0.5));
      CHECK(times_q15(first, second) == std::floor(a * b / 32768.0 + 0.5));
    }
  }
}

TEST_CASE("numbers are limited to both sides alike") {
  CHECK(clamped(2000000000, 5) == 5);
  CHECK(clamped(-2000000000, 5) == -5);
  CHECK(clamped(-4, 5) == -4);
  CHECK(clamped16(-32768, 32767) == -32767);
  CHECK(to_int16(32768) == 32767);
  CHECK(to_int16(-32768) == -32767);
  CHECK(to_int16(-65537) == -32767);
  CHECK(to_int16(-12345) == -12345);
}

TEST_CASE("a vector product stands on both vectors") {
  const int16_t a[3] = {100, -2000, 30000};
  const int16_t b[3] = {-7, 12000, 500};
  int32_t result[3];
  cross(a, b, result);
  CHECK(result[0] == -2000 * 500 - 30000 * 12000);
  CHECK(result[1] == 30000 * -7 - 100 * 500);
  CHECK(result[2] == 100 * 12000 - -2000 * -7);
  CHECK(dot(a, b) == 100 * -7 + -2000 * 12000 + 30000 * 500);
}
