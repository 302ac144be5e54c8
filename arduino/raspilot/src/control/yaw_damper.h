/** Damps yawing without holding a yaw angle, which would need a magnetometer. */
#pragma once

#include "cascade.h"

namespace raspilot {

/** A Rate PID on the yaw rate less its mean over 2 s: a steady turn passes, swinging is damped. */
class YawDamper {
 public:
  void tune(const PidGains& gains) { loop_.tune(gains); }
  void reset();
  /** Deflection, ticks; `wanted_16` is a rate that is asked on top of the steady one. */
  Ticks damp(int16_t wanted_16, int16_t rate_16);

 private:
  RateLoop loop_;
  int32_t steady_ = 0;  // 2^-10 of a sixteenth
  bool has_steady_ = false;
};

}  // namespace raspilot
