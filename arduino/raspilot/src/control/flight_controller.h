/** Rate and Stabilize PIDs for three axes, limits, mixes: from sticks and attitude to servos. */
#pragma once

#include "../core/reference.h"
#include "../core/types.h"
#include "../store/gains.h"
#include "../store/profile.h"
#include "pid.h"

namespace raspilot {

/** The rotation rates at full stick in RATE, deg/s. */
constexpr int16_t ROLL_STICK_DEG_S = 180;
constexpr int16_t PITCH_STICK_DEG_S = 90;
/** The fastest rotations that an angle demands, deg/s, as in the Raspberry Pi's controller. */
constexpr int16_t ROLL_RATE_LIMIT_DEG_S = 120;
constexpr int16_t PITCH_RATE_LIMIT_DEG_S = 80;
/** The same of roll beyond 90 degrees of bank, where height is lost until the ailerons are done. */
constexpr int16_t INVERTED_ROLL_RATE_LIMIT_DEG_S = 225;

/** The controller's demand in this slot. */
struct Demand {
  Mode mode;
  /** Receiver failsafe: circle when the IMU is valid, preset surfaces otherwise. */
  bool is_failsafe;
  bool is_imu_valid;
  /** Sticks, calibrated, ticks (AILERONS, ELEVATOR, THROTTLE, RUDDER). */
  Ticks sticks[OUTPUTS];
  /** Throttle by the rules of Authority, ticks. */
  Ticks throttle;
  Asked asked;
};

/** Which controllers are in the loop; their state is cleared when they leave it. */
enum class Hold : uint8_t { NOTHING, RATES, ANGLES };

/** The controller's state; all of it zero at first. */
struct ControllerMemory {
  Outputs outputs_;
  Hold hold_;
  bool has_steady_;
  uint8_t tuned_loops_;
  uint8_t slots_to_slew_;
  int32_t steady_;     // yaw rate of the turn, 2^-16 of a sixteenth of a deg/s
  Pid rate_[3];        // ailerons, elevator, rudder: sixteenths of a deg/s to 1.25 us
  Pid stabilize_[2];   // ailerons, elevator: degrees / 128 to deg/s
};

/**
 * Stick 2000 us on ailerons rolls right, on elevator raises the nose, on rudder yaws right, before
 * the servos' own directions. Every mode passes the servo stage (mix, direction, trim, end points),
 * the Raspberry Pi's Outputs too: they equal a pilot's sticks and are independent of the airframe.
 *
 * ACRO and OUTPUT pass through. RATE: the stick is a rate. FBW: the stick is a bank and a pitch.
 * SETPOINT: both come from the Raspberry Pi, within the limits of FBW. In the last three the rudder
 * is the stick plus the yaw damper. RETURN: SETPOINT without a stick, in receiver failsafe. Without a valid IMU every mode passes the sticks through.
 */
class FlightController : private ControllerMemory {
 public:
  FlightController(const Profile& profile, const Gains& gains);

  /** Takes over gains after they changed: one loop a slot, because it takes a while. */
  void on_gains() { tuned_loops_ = 0; }
  /** One slot of 2000 us; returns the pulses after mix, reversal, trim and travel limits. */
  const Outputs& update(const Demand& demand, const Attitude& attitude);
  const Outputs& outputs() const { return outputs_; }

 private:
  void tune_one();
  void engage(Hold hold);
  static Hold hold_of(const Demand& demand);
  Ticks slewed(Ticks throttle);
  void pass_through(const Demand& demand, Ticks* demands) const;
  void hold_rates(const Demand& demand, const Attitude& attitude, Ticks* demands);
  int16_t wanted_rate_16(Channel channel, const Demand& demand, const Attitude& attitude);
  static int16_t pitch_rate_in_turn_16(int16_t wanted_16, const Attitude& attitude);
  int16_t wanted_angle_cdeg(Channel channel, const Demand& demand) const;
  int16_t swinging_16(int16_t yaw_rate_16);
  Ticks deflection(uint8_t axis, int16_t wanted_16, int16_t rate_16);

  Reference<const Profile> profile_;
  Reference<const Gains> gains_;
};

}  // namespace raspilot
