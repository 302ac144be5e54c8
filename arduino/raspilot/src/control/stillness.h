/** Finds seconds in which the aircraft does not turn, and the gyro's reading in them. */
#pragma once

#include <stdint.h>

namespace raspilot {

/**
 * Checks windows of 256 samples, every other slot's one: 1.02 s. A window restarts with the first
 * sample that differs from the window's first one by more than 1.2 deg/s.
 */
class Stillness {
 public:
  /** Takes a gyro sample, chip counts; true when a still window ends with it. */
  bool on_sample(const int16_t* gyro);
  /** Samples are missing: clears the state. */
  void reset();
  /** Whether a window was still and nothing has moved since. */
  bool is_still() const { return is_still_; }
  /** Mean of the newest still window, sixteenths of a chip count. */
  const int16_t* mean_q4() const { return mean_q4_; }

 private:
  // Initialised to zero by the owner.
  int16_t first_[3];
  int16_t sums_[3];
  int16_t mean_q4_[3];
  uint16_t samples_;
  bool is_still_;
};

}  // namespace raspilot
