/** Values that every part of the firmware shares, with their units. */
#pragma once

#include <stdint.h>

#include "status_schema.h"

namespace raspilot {

/** A pulse width or a moment of Timer1 in half microseconds: 1500 us is 3000. */
typedef int16_t Ticks;

constexpr Ticks us_to_ticks(int16_t us) { return static_cast<Ticks>(us * 2); }
/** Whole microseconds of a pulse, rounded half up. */
constexpr uint16_t ticks_to_us(Ticks ticks) { return static_cast<uint16_t>((ticks + 1) / 2); }

/** The receiver's channels in the order of the wire; the first four are servo outputs too. */
enum Channel : uint8_t { AILERONS, ELEVATOR, THROTTLE, RUDDER, AUX1, AUX2 };
constexpr uint8_t INPUTS = 6;
constexpr uint8_t OUTPUTS = 4;
constexpr uint8_t ALL_INPUTS = 0x3F;

/**
 * Attitude and rotation in body axes (x forward, y right, z down): roll right wing down, pitch
 * nose up, yaw clockwise from above. Angles in hundredths of a degree (yaw and roll -18000 to
 * 18000, pitch -9000 to 9000), rates in sixteenths of a degree per second.
 * Sines and cosines are Q14; the cosine of pitch is at least 0.2.
 */
struct Attitude {
  int16_t roll_cdeg;
  int16_t pitch_cdeg;
  int16_t yaw_cdeg;
  int16_t roll_rate_16;
  int16_t pitch_rate_16;
  int16_t yaw_rate_16;
  int16_t sin_roll;
  int16_t cos_roll;
  int16_t sin_pitch;
  int16_t cos_pitch;
};

/** The Raspberry Pi's demand in `S`; throttle 0 is the stick's. */
struct Setpoint {
  int16_t roll_cdeg;
  int16_t pitch_cdeg;
  int16_t yaw_rate_cdeg_s;
  uint16_t throttle_us;
};

/** The four pulses that go to the servos, in ticks. */
struct Outputs {
  Ticks ticks[OUTPUTS];
};

/** What the Raspberry Pi asks for: the mode is SETPOINT, RETURN or OUTPUT. */
union Asked {
  Setpoint setpoint;
  Outputs outputs;
};

}  // namespace raspilot
