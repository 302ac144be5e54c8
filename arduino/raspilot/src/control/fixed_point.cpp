#include "fixed_point.h"

namespace raspilot {

OUT_OF_LINE void cross(const int16_t* a, const int16_t* b, int32_t* result) {
  uint8_t next = 1;
  uint8_t last = 2;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    result[axis] = product(a[next], b[last]) - product(a[last], b[next]);
    next = last;
    last = axis;
  }
}

OUT_OF_LINE int32_t dot(const int16_t* a, const int16_t* b) {
  int32_t sum = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) sum += product(a[axis], b[axis]);
  return sum;
}

OUT_OF_LINE int16_t times_q15(int16_t a, int16_t b) {
  return static_cast<int16_t>((static_cast<uint32_t>(product(a, b)) * 2 + 0x8000U) >> 16);
}

OUT_OF_LINE int16_t times_q14(int16_t a, int16_t b) { return from_q14(product(a, b)); }

OUT_OF_LINE int32_t shifted(int32_t value, uint8_t bits) { return value >> bits; }

OUT_OF_LINE int32_t clamped(int32_t value, int32_t limit) {
  if (value > limit) return limit;
  return value < -limit ? -limit : value;
}

OUT_OF_LINE int16_t clamped16(int16_t value, int16_t limit) {
  if (value > limit) return limit;
  return value < -limit ? static_cast<int16_t>(-limit) : value;
}

OUT_OF_LINE int16_t to_int16(int32_t value) {
  return static_cast<int16_t>(clamped(value, 32767));
}

namespace {

/** The sum of `a` and `other`, cut to 16 bits, or the end that it is beyond. */
OUT_OF_LINE int16_t within(uint16_t sum, int16_t a, uint16_t other) {
  const uint16_t sign = static_cast<uint16_t>(a);
  const bool is_beyond = (~(sign ^ other) & (sign ^ sum) & 0x8000) != 0;
  if (is_beyond) return a < 0 ? -32767 : 32767;
  return sum == 0x8000 ? -32767 : static_cast<int16_t>(sum);
}

}  // namespace

OUT_OF_LINE int16_t sum_of(int16_t a, int16_t b) {
  const uint16_t other = static_cast<uint16_t>(b);
  return within(static_cast<uint16_t>(static_cast<uint16_t>(a) + other), a, other);
}

OUT_OF_LINE int16_t difference_of(int16_t a, int16_t b) {
  const uint16_t other = static_cast<uint16_t>(b);
  // Its complement has the sign of the addend.
  return within(static_cast<uint16_t>(static_cast<uint16_t>(a) - other), a,
                static_cast<uint16_t>(~other));
}

}  // namespace raspilot
