/** How the sensor is tilted in the airframe, and its measurements turned straight. */
#pragma once

#include <stdint.h>

namespace raspilot {

/** Turns (a, b) in their plane by the angle of sine and cosine, Q14. */
void turn(int16_t& a, int16_t& b, int16_t sine, int16_t cosine);

/** The sensor's roll and pitch while the airframe is level; call `set` first. */
class Level {
 public:
  static constexpr int16_t MAX_CDEG = 1500;

  void set(int16_t roll_cdeg, int16_t pitch_cdeg);
  /** Turns a vector of at most 32000 from the sensor's axes (forward, right, down) straight. */
  void straighten(int16_t* vector) const;
  /** The way back. */
  void tilt(int16_t* vector) const;

 private:
  int16_t roll_sine_;
  int16_t roll_cosine_;
  int16_t pitch_sine_;
  int16_t pitch_cosine_;
};

}  // namespace raspilot
