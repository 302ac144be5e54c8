#include "fixed_point.h"

namespace raspilot {

namespace {
constexpr int32_t GREATEST_16 = 32767;
}

#define OUT_OF_LINE __attribute__((noinline))

OUT_OF_LINE int32_t cross(int16_t a, int16_t b, int16_t c, int16_t d) {
  return product(a, b) - product(c, d);
}

OUT_OF_LINE int32_t sum_of_squares(const int16_t* vector) {
  int32_t sum = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) sum += product(vector[axis], vector[axis]);
  return sum;
}

OUT_OF_LINE int16_t times_q14(int16_t a, int16_t b) {
  return static_cast<int16_t>((product(a, b) + (1L << 13)) >> 14);
}

OUT_OF_LINE int16_t times_q15(int16_t a, int16_t b) {
  return static_cast<int16_t>((product(a, b) + (1L << 14)) >> 15);
}

OUT_OF_LINE int32_t rounded(int32_t value, uint8_t bits) {
  value >>= bits - 1;
  return (value + 1) >> 1;
}

OUT_OF_LINE int16_t upper_half(int32_t value) {
  return to_int16((value >> 16) + ((value >> 15) & 1));
}

OUT_OF_LINE int32_t clamped(int32_t value, int32_t limit) {
  return value > limit ? limit : value < -limit ? -limit : value;
}

OUT_OF_LINE int16_t clamped16(int16_t value, int16_t limit) {
  return value > limit ? limit : value < -limit ? static_cast<int16_t>(-limit) : value;
}

OUT_OF_LINE int16_t to_int16(int32_t value) {
  return static_cast<int16_t>(clamped(value, GREATEST_16));
}

OUT_OF_LINE int16_t sum_of(int16_t a, int16_t b) { return to_int16(static_cast<int32_t>(a) + b); }

OUT_OF_LINE int16_t difference_of(int16_t a, int16_t b) {
  return to_int16(static_cast<int32_t>(a) - b);
}

#undef OUT_OF_LINE

}  // namespace raspilot
