/**
 * Arithmetic in whole numbers that reads the same on the chip and on a PC. `Qn` says that 2^n is 1.
 * On the chip `int` has 16 bits: a product of two of them is widened here, before it is too late.
 */
#pragma once

#include <stdint.h>

namespace raspilot {

inline int32_t product(int16_t a, int16_t b) { return static_cast<int32_t>(a) * b; }
inline int32_t scaled(uint16_t gain, int16_t value) {
  return static_cast<int32_t>(gain) * static_cast<int32_t>(value);
}

inline int32_t clamped(int32_t value, int32_t limit) {
  return value > limit ? limit : value < -limit ? -limit : value;
}
inline int16_t to_int16(int32_t value) { return static_cast<int16_t>(clamped(value, 32767)); }

/** `value` / 2^bits, to the nearest. */
inline int32_t rounded(int32_t value, uint8_t bits) {
  return (value + (static_cast<int32_t>(1) << (bits - 1))) >> bits;
}

}  // namespace raspilot
