/**
 * Integer arithmetic with the same results on the chip and on a PC. `Qn` means that 2^n is 1.
 * On the chip `int` has 16 bits: a product of two of them is widened here before it overflows.
 * Operations that take the chip many instructions are kept out of line.
 */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"

namespace raspilot {

inline int32_t product(int16_t a, int16_t b) { return static_cast<int32_t>(a) * b; }
inline int32_t scaled(uint16_t gain, int16_t value) {
  return static_cast<int32_t>(gain) * static_cast<int32_t>(value);
}

/** The vector product of `a` and `b`. */
void cross(const int16_t* a, const int16_t* b, int32_t* result);
/** Sum of the products of three pairs; no partial sum may leave 32 bits. */
int32_t dot(const int16_t* a, const int16_t* b);

/** Products of which one factor is a fraction, to the nearest, where that fits in 16 bits. */
int16_t times_q14(int16_t a, int16_t b);
int16_t times_q15(int16_t a, int16_t b);

/** `value` / 2^bits, rounded down; a bit takes the chip seven cycles. */
int32_t shifted(int32_t value, uint8_t bits);
/**
 * `value` / 2^16 and / 2^14, to the nearest, where that fits in 16 bits. On the chip the upper half
 * of a number costs nothing, a shift to the right a cycle a byte and bit.
 */
inline int16_t upper_half(int32_t value) {
  return static_cast<int16_t>((static_cast<uint32_t>(value) + 0x8000U) >> 16);
}
inline int16_t from_q14(int32_t value) {
  return static_cast<int16_t>((static_cast<uint32_t>(value) * 4 + 0x8000U) >> 16);
}

int32_t clamped(int32_t value, int32_t limit);
int16_t clamped16(int16_t value, int16_t limit);
/** The nearest of -32767 to 32767. */
int16_t to_int16(int32_t value);

/** a + b and a - b, within 16 bits. */
int16_t sum_of(int16_t a, int16_t b);
int16_t difference_of(int16_t a, int16_t b);
inline int16_t negative(int16_t value) { return difference_of(0, value); }

}  // namespace raspilot
