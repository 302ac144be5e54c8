/** Rate and Stabilize PIDs for three axes, limits, mixes: from sticks and attitude to servos. */
#pragma once

#include "../core/types.h"
#include "../store/gains.h"
#include "../store/profile.h"

namespace raspilot {

/** What the controller is to do in this slot. */
struct Demand {
  Mode mode;
  /** Receiver failsafe: circle when the IMU is valid, preset surfaces otherwise. */
  bool is_failsafe;
  bool is_imu_valid;
  /** Sticks, calibrated, ticks (AILERONS, ELEVATOR, THROTTLE, RUDDER). */
  Ticks sticks[OUTPUTS];
  /** Throttle by the rules of Authority, ticks. */
  Ticks throttle;
  Setpoint setpoint;
  /** The Raspberry Pi's, ticks (mode OUTPUT). */
  Outputs asked;
};

class FlightController {
 public:
  FlightController(const Profile& profile, const Gains& gains);

  /** Takes over gains after they changed. */
  void on_gains();
  /** One slot of 2000 us; returns the pulses after mix, reversal, trim and travel limits. */
  const Outputs& update(const Demand& demand, const Attitude& attitude);
  const Outputs& outputs() const;
};

}  // namespace raspilot
