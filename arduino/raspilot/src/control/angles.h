/** Trigonometry in hundredths of a degree without floating point. */
#pragma once

#include <stdint.h>

namespace raspilot {

/** Angle of the point (x, y), -18000 to 18000, within 0.02 degrees; 0 for (0, 0). */
int16_t arc_tangent_cdeg(int16_t y, int16_t x);
/** Square root, rounded down. */
uint16_t square_root(uint32_t square);

/** Sine and cosine in Q14 for angles of at most 15 degrees. */
int16_t small_sine_q14(int16_t angle_cdeg);
int16_t small_cosine_q14(int16_t angle_cdeg);

/** `part` / `whole`, -1 to 1 in Q14; `whole` is positive. */
int16_t ratio_q14(int16_t part, int16_t whole);

}  // namespace raspilot
