/** Two PID controllers after one another: angle to rate of rotation to servo (thesis 3.3.2). */
#pragma once

#include <stdint.h>

#include "../core/types.h"
#include "pid.h"

namespace raspilot {

/** The Rate PID's 400 units of 1.25 us: half of a servo's way. */
constexpr int16_t RATE_OUTPUT_LIMIT = 400;

/** Rate PID: 1/16 deg/s in, deflection in ticks out. */
class RateLoop {
 public:
  RateLoop();
  void tune(const PidGains& gains) { pid_.tune(gains); }
  void reset() { pid_.reset(); }
  Ticks hold(int16_t wanted_16, int16_t rate_16);

 private:
  Pid pid_;
};

/** Stabilize PID before a Rate PID: hundredths of a degree in, deflection in ticks out. */
class Cascade {
 public:
  /** `rate_limit_deg_s` is the fastest rotation that an angle asks for. */
  explicit Cascade(int16_t rate_limit_deg_s);
  void tune_rate(const PidGains& gains) { rate_.tune(gains); }
  void tune_stabilize(const PidGains& gains) { stabilize_.tune(gains); }
  void reset_rate() { rate_.reset(); }
  void reset_stabilize() { stabilize_.reset(); }
  Ticks hold_angle(int16_t wanted_cdeg, int16_t angle_cdeg, int16_t rate_16);
  Ticks hold_rate(int16_t wanted_16, int16_t rate_16) { return rate_.hold(wanted_16, rate_16); }

 private:
  Pid stabilize_;
  RateLoop rate_;
};

}  // namespace raspilot
