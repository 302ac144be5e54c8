#include "angles.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

// arctan(x) = x (c0 + c1 x^2 + c2 x^4 + c3 x^6) for 0 to 1, error below 0.006 degrees (Hastings,
// Approximations for Digital Computers, sheet 8 with one term less), in quarters of 0.01 degrees.
constexpr int16_t C0 = 22900;
constexpr int16_t C1 = -7361;
constexpr int16_t C2 = 3352;
constexpr int16_t C3 = -894;

constexpr int16_t RIGHT_ANGLE = 9000;
constexpr int16_t HALF_CIRCLE = 18000;
constexpr int16_t ONE_Q14 = 16384;
constexpr int16_t TURN_Q13 = 23426;  // a hundredth of a degree in Q14

OUT_OF_LINE uint16_t magnitude(int16_t value) {
  const uint16_t bits = static_cast<uint16_t>(value);
  return value < 0 ? static_cast<uint16_t>(0U - bits) : bits;
}

/** shorter / longer, at most 32767; the library's division of 32 bits takes three times as long. */
OUT_OF_LINE uint16_t ratio_q15(uint16_t shorter, uint16_t longer) {
  uint16_t ratio = 0;
  if (shorter == longer) return longer == 0 ? 0 : 32767;
  for (uint8_t bit = 0; bit < 15; ++bit) {
    shorter = static_cast<uint16_t>(shorter << 1);
    ratio = static_cast<uint16_t>(ratio << 1);
    if (shorter >= longer) {
      shorter = static_cast<uint16_t>(shorter - longer);
      ++ratio;
    }
  }
  return ratio;
}

/** Angle of a slope of 0 to 1 in Q15. */
int16_t arc_tangent_of_slope(int16_t slope_q15) {
  const int16_t square = times_q15(slope_q15, slope_q15);
  int16_t sum = static_cast<int16_t>(C2 + times_q15(C3, square));
  sum = static_cast<int16_t>(C1 + times_q15(sum, square));
  sum = static_cast<int16_t>(C0 + times_q15(sum, square));
  return static_cast<int16_t>((times_q15(sum, slope_q15) + 2) >> 2);
}

OUT_OF_LINE int16_t radians_q14(int16_t angle_cdeg) {
  return times_q14(static_cast<int16_t>(angle_cdeg * 2), TURN_Q13);
}

}  // namespace

OUT_OF_LINE int16_t ratio_q14(int16_t part, int16_t whole) {
  const uint16_t size = magnitude(part);
  const uint16_t most = static_cast<uint16_t>(whole);
  const int16_t ratio = static_cast<int16_t>(ratio_q15(size < most ? size : most, most) >> 1);
  return part < 0 ? static_cast<int16_t>(-ratio) : ratio;
}

OUT_OF_LINE int16_t arc_tangent_cdeg(int16_t y, int16_t x) {
  const uint16_t across = magnitude(y);
  const uint16_t along = magnitude(x);
  const bool is_steep = across > along;
  const uint16_t slope_q15 = is_steep ? ratio_q15(along, across) : ratio_q15(across, along);
  int16_t angle = arc_tangent_of_slope(static_cast<int16_t>(slope_q15));
  if (is_steep) angle = static_cast<int16_t>(RIGHT_ANGLE - angle);
  if (x < 0) angle = static_cast<int16_t>(HALF_CIRCLE - angle);
  return y < 0 ? static_cast<int16_t>(-angle) : angle;
}

uint16_t square_root(uint32_t square) {
  uint16_t root = 0;
  for (uint16_t bit = 0x8000; bit != 0; bit >>= 1) {
    const uint16_t trial = root | bit;
    if (static_cast<uint32_t>(trial) * trial <= square) root = trial;
  }
  return root;
}

int16_t small_sine_q14(int16_t angle_cdeg) {
  const int16_t x = radians_q14(angle_cdeg);
  // A sixth of the cube, in Q14.
  return static_cast<int16_t>(x - times_q14(times_q14(times_q14(x, x), x), 2731));
}

int16_t small_cosine_q14(int16_t angle_cdeg) {
  const int16_t x = radians_q14(angle_cdeg);
  return static_cast<int16_t>(ONE_Q14 - times_q15(x, x));
}

}  // namespace raspilot
