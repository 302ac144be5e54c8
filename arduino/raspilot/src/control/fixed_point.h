/**
 * Arithmetic in whole numbers that reads the same on the chip and on a PC. `Qn` says that 2^n is 1.
 * On the chip `int` has 16 bits: a product of two of them is widened here, before it is too late.
 * What the chip needs many instructions for is kept out of line.
 */
#pragma once

#include <stdint.h>

namespace raspilot {

inline int32_t product(int16_t a, int16_t b) { return static_cast<int32_t>(a) * b; }
inline int32_t scaled(uint16_t gain, int16_t value) {
  return static_cast<int32_t>(gain) * static_cast<int32_t>(value);
}

/** a b - c d. */
int32_t cross(int16_t a, int16_t b, int16_t c, int16_t d);
/** Sum of the squares of three numbers; none above 26000. */
int32_t sum_of_squares(const int16_t* vector);

/** Products of which one factor is a fraction, to the nearest. */
int16_t times_q14(int16_t a, int16_t b);
int16_t times_q15(int16_t a, int16_t b);

/** `value` / 2^bits, to the nearest. */
int32_t rounded(int32_t value, uint8_t bits);
/** `value` / 2^16, to the nearest, within 16 bits. */
int16_t upper_half(int32_t value);

int32_t clamped(int32_t value, int32_t limit);
int16_t clamped16(int16_t value, int16_t limit);
/** The nearest of -32767 to 32767. */
int16_t to_int16(int32_t value);

/** a + b and a - b, within 16 bits. */
int16_t sum_of(int16_t a, int16_t b);
int16_t difference_of(int16_t a, int16_t b);

}  // namespace raspilot
