#include <doctest/doctest.h>

#include <cmath>

#include "control/angles.h"
#include "control/level.h"

using namespace raspilot;

namespace {
constexpr double CDEG = 3.14159265358979323846 / 18000;

double away_cdeg(double a, double b) { return std::fabs(std::remainder(a - b, 36000.0)); }
}  // namespace

TEST_CASE("the arc tangent is right to two hundredths of a degree all round the circle") {
  double greatest = 0;
  for (int angle = -17999; angle <= 18000; angle += 7) {
    const int16_t y = static_cast<int16_t>(std::lround(16384 * std::sin(angle * CDEG)));
    const int16_t x = static_cast<int16_t>(std::lround(16384 * std::cos(angle * CDEG)));
    greatest = std::fmax(greatest, away_cdeg(arc_tangent_cdeg(y, x), angle));
  }
  CHECK(greatest <= 2.0);
}

TEST_CASE("the arc tangent takes every pair of numbers") {
  CHECK(arc_tangent_cdeg(0, 0) == 0);
  for (int y = -32768; y <= 32767; y += 1311) {
    for (int x = -32768; x <= 32767; x += 997) {
      const int16_t angle = arc_tangent_cdeg(static_cast<int16_t>(y), static_cast<int16_t>(x));
      CHECK(away_cdeg(angle, std::atan2(y, x) / CDEG) <= 3.0);
      CHECK(angle >= -18000);
      CHECK(angle <= 18000);
    }
  }
}

TEST_CASE("a square root is rounded down") {
  for (uint64_t square = 0; square <= 0xFFFFFFFFu; square += square / 37 + 1) {
    const double expected = std::floor(std::sqrt(static_cast<double>(square)));
    CHECK(square_root(static_cast<uint32_t>(square)) == expected);
  }
  CHECK(square_root(0xFFFFFFFFu) == 65535);
}

TEST_CASE("sines and cosines of small angles are right to a four thousandth") {
  for (int angle = -1500; angle <= 1500; angle += 3) {
    const int16_t cdeg = static_cast<int16_t>(angle);
    CHECK(std::fabs(small_sine_q14(cdeg) - 16384 * std::sin(angle * CDEG)) <= 8);
    CHECK(std::fabs(small_cosine_q14(cdeg) - 16384 * std::cos(angle * CDEG)) <= 8);
  }
}

TEST_CASE("a tilted vector is straightened, and tilted back again") {
  for (int roll = -1500; roll <= 1500; roll += 250) {
    for (int pitch = -1500; pitch <= 1500; pitch += 250) {
      Level level;
      level.set(static_cast<int16_t>(roll), static_cast<int16_t>(pitch));
      const double across = std::cos(pitch * CDEG);
      const double down[3] = {-std::sin(pitch * CDEG), std::sin(roll * CDEG) * across,
                              std::cos(roll * CDEG) * across};
      int16_t vector[3];
      for (int axis = 0; axis < 3; ++axis) {
        vector[axis] = static_cast<int16_t>(std::lround(10000 * down[axis]));
      }
      level.straighten(vector);
      CHECK(std::abs(vector[0]) <= 8);
      CHECK(std::abs(vector[1]) <= 8);
      CHECK(std::abs(vector[2] - 10000) <= 12);
      level.tilt(vector);
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(std::fabs(vector[axis] - 10000 * down[axis]) <= 16);
      }
    }
  }
}
