/**
 * Who flies: switch, arming, authority of the Raspberry Pi, receiver failsafe. Knows no chip.
 */
#pragma once

#include "../core/reference.h"
#include "../core/compiler.h"
#include "../core/types.h"
#include "../store/profile.h"
#include "lifetime.h"
#include "pwm_reader.h"
#include "switches.h"

namespace raspilot {

/** State that survives a watchdog reset. */
struct AuthorityState {
  bool is_armed;
  uint8_t switch_position;
  char requested_mode;
  /** Stays after more than 5 s of failsafe until the stick has been low. */
  bool is_throttle_latched;
  bool is_failsafe;
};

/**
 * A receiver is valid when all six channels have been for 30 ms (a whole frame, so that no channel
 * still shows a value from the loss) and the throttle is not below the profile's threshold, which
 * indicates the receiver's own failsafe. That failsafe acts immediately, any other loss after
 * 500 ms, during which the sticks hold still. Neither the loss nor the return of a receiver counts
 * as a switch movement: it neither arms nor disarms nor ends the mode requested by the ground.
 *
 * Before the first valid receiver no mode acts: FBW holds level with centred sticks, and this does
 * not count as failsafe. Lifetimes end with the slot in which they run out.
 */
class Authority {
 public:
  Authority(const Profile& profile, const PwmReader& receiver);

  /** Checks the receiver and the lifetimes; each slot. */
  void update(bool is_imu_valid, bool is_calibrating, bool is_profile_broken, uint32_t now_us);

  /**
   * The mode reported to the Raspberry Pi: flown_mode(), but OUTPUT also for 500 ms after `M`
   * requested it, so that a Raspberry Pi that waits for it learns that it may begin.
   */
  Mode mode() const;
  /**
   * The mode in effect, after switch, requested mode, lifetimes, failsafe and IMU: FBW at AUTO
   * without a valid Setpoint or Output; ACRO instead of modes that need an IMU that is invalid.
   */
  Mode flown_mode() const;
  bool is_armed() const { return is_armed_; }
  bool is_auto() const;
  /**
   * Whether settings must not change: armed, or an aircraft without a motor, which flies disarmed,
   * unless it has been on for 5 s and its receiver was never valid.
   */
  bool is_in_flight(uint16_t uptime_s) const;
  /** 0 low, 1 middle, 2 high, 255 not known yet; holds while the receiver is lost. */
  uint8_t switch_position() const { return switch_.position(); }
  bool has_receiver() const { return !(slot_vetoes_ & VETO_RECEIVER_INVALID); }
  /** Receiver failsafe acts: circle (IMU valid) or preset surfaces. */
  bool is_failsafe() const { return is_failsafe_; }
  uint8_t vetoes() const;

  /** The throttle pulse for the ESC by every rule, ticks; 1000 us while disarmed with a motor. */
  Ticks throttle() const;
  /** Of the flown mode SETPOINT, RETURN or OUTPUT; throttle 0 is the stick's: see throttle(). */
  const Asked& asked() const { return asked_; }

  /** Refused by any veto: throttle, receiver and IMU have their own reasons. */
  Reason arm();
  /** With a motor, refused unless the throttle stick was seen low for the last 2 s. */
  Reason disarm();
  /** `M`: only with the switch at AUTO; never ACRO. */
  Reason request_mode(char letter);
  /**
   * `u`; `age_us` is that of the orientation that it was computed from. Holds for 250 ms. Values
   * are in range, here and in a Setpoint: the reader of the wire refuses others.
   */
  Reason accept_outputs(const uint16_t* pulses_us, uint32_t age_us);
  Reason accept_setpoint(const Setpoint& setpoint, uint16_t lifetime_ms);
  /**
   * `R`: as a Setpoint, in receiver failsafe only and where the profile allows it. When the receiver
   * is back it goes on until the pilot leaves AUTO or moves a stick, or until it is not renewed.
   */
  Reason accept_return(const Setpoint& setpoint, uint16_t lifetime_ms);
  /** `v`: holds for 1 s. */
  void accept_veto(bool is_vetoed);

  AuthorityState state() const;
  /** After a watchdog reset only. */
  void restore(const AuthorityState& state, uint32_t now_us);

 private:
  /** States with a lifetime. */
  enum Life : uint8_t { ASKED, OUTPUT, DEMAND, RETURNING, PI_VETO, TIMEOUTS };

  void follow_receiver(uint16_t passed_units);
  void follow_failsafe(bool is_own_failsafe, uint16_t passed_units);
  void follow_arming(uint16_t passed_units);
  bool is_pilot_back(uint16_t passed_units);
  bool may_use_motor() const;
  void follow(Life life, const Setpoint& setpoint, uint16_t lifetime_ms);
  bool has_imu() const { return !(slot_vetoes_ & VETO_IMU_INVALID); }
  bool is_throttle_low() const;
  bool was_heard() const { return switch_.position() != SWITCH_UNKNOWN; }
  void end_demands();
  /** Why the Raspberry Pi may not fly in this mode now. */
  Reason authority_for(Mode mode) const;

  Reference<const Profile> profile_;
  Reference<const PwmReader> receiver_;
  ModeSwitch switch_;
  ArmingSwitch arming_;
  Lifetime timeouts_[TIMEOUTS];
  Stopwatch throttle_low_;
  Stopwatch rx_ok_timer_;
  Stopwatch lost_;
  Stopwatch away_;
  /** In failsafe, without a return set-point. */
  Stopwatch motor_off_;
  /** Frames were valid again in failsafe; where the sticks stood after a second of them. */
  Stopwatch back_;
  Ticks rest_[OUTPUTS] ZEROED;
  // The newer of the two: flown_mode() returns which it is.
  Asked asked_ ZEROED;
  uint16_t updated_at_ ZEROED;
  char requested_mode_ ZEROED;
  bool is_armed_ ZEROED;
  /** Those that hold for a slot: receiver, IMU, calibrating, profile. */
  uint8_t slot_vetoes_ = VETO_RECEIVER_INVALID | VETO_IMU_INVALID;
  bool is_failsafe_ ZEROED;
  bool is_latched_ ZEROED;
};

}  // namespace raspilot
