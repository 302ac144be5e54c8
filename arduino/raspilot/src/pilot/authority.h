/**
 * Who flies: switch, arming, authority of the Raspberry Pi, receiver failsafe. Knows no chip.
 */
#pragma once

#include "../core/types.h"
#include "../store/profile.h"
#include "pwm_reader.h"

namespace raspilot {

/** Veto bits of the status (docs/protocols.md 2.7, offset 4). */
enum Veto : uint8_t {
  VETO_THROTTLE = 1,
  VETO_RECEIVER = 2,
  VETO_IMU = 4,
  VETO_AUX2 = 8,
  VETO_RASPBERRY = 16,
  VETO_CALIBRATING = 32,
  VETO_PROFILE = 64
};

/** What survives a watchdog reset. */
struct AuthorityState {
  bool is_armed;
  uint8_t switch_position;
  char asked_mode;
  bool is_throttle_latched;
  bool is_failsafe;
};

class Authority {
 public:
  Authority(const Profile& profile, const PwmReader& receiver);

  /** Looks at the receiver and at the lifetimes; each slot. */
  void update(bool is_imu_valid, bool is_calibrating, bool is_profile_broken, uint32_t now_us);

  /** What flies now: the mode after switch, asked mode, lifetimes, failsafe and IMU. */
  Mode mode() const;
  bool is_armed() const;
  bool is_auto() const;
  /** 0 low, 1 middle, 2 high, 255 not known yet. */
  uint8_t switch_position() const;
  bool has_receiver() const;
  /** Receiver failsafe acts: circle (IMU valid) or preset surfaces. */
  bool is_failsafe() const;
  /** Stays after more than 5 s of failsafe until the stick has been low. */
  bool is_throttle_latched() const;
  uint8_t vetoes() const;

  /** The throttle pulse for the ESC by every rule, ticks; 1000 us while disarmed with a motor. */
  Ticks throttle() const;
  const Setpoint& setpoint() const;
  const Outputs& asked_outputs() const;

  Reason arm(uint32_t now_us);
  Reason disarm(uint32_t now_us);
  /** `M`: only with the switch at AUTO; never ACRO. */
  Reason ask_mode(char letter, uint32_t now_us);
  /** `u`; `age_us` is that of the orientation that it was computed from. */
  Reason take_outputs(const uint16_t* pulses_us, uint32_t age_us, uint32_t now_us);
  Reason take_setpoint(const Setpoint& setpoint, uint16_t lifetime_ms, uint32_t now_us);
  /** `v`: holds for 1 s. */
  void take_veto(bool is_vetoed, uint32_t now_us);

  AuthorityState state() const;
  /** After a watchdog reset only. */
  void restore(const AuthorityState& state, uint32_t now_us);
};

}  // namespace raspilot
