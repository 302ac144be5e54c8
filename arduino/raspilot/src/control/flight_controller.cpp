#include "flight_controller.h"

#include "angles.h"
#include "fixed_point.h"
#include "servo_stage.h"

namespace raspilot {

namespace {

constexpr uint8_t ROLL = 0;
constexpr uint8_t PITCH = 1;
constexpr uint8_t YAW = 2;
constexpr uint8_t RATE_LOOPS = 3;
constexpr uint8_t LOOPS = 5;

constexpr Ticks NEUTRAL = us_to_ticks(1500);
// The slew limit's steps are 10 ms apart.
constexpr uint8_t SLEW_SLOTS = 5;
constexpr int16_t FULL_STICK = 1000;
// Thirty-seconds of a full stick's 1000 ticks to Q15: 32.766 in Q14 less five bits.
constexpr int16_t STICK_TO_Q15 = 16776;
// A hundredth of a degree per second in sixteenths, Q15.
constexpr int16_t CDEG_TO_16THS = 5243;

// Rates are in 2^-4, so a Rate PID answers in 2^-14. Its 400 units of 1.25 us are half a servo's
// travel; a unit is 2.5 ticks.
constexpr int32_t RATE_LIMIT = 400L << 14;
constexpr int32_t UNIT_TO_UPPER_HALF = 10;
// Angles are in 2^-7, so a Stabilize PID answers in 2^-17 of a deg/s: 2^13 make a sixteenth.
constexpr int32_t RATE_TO_LIMIT = 1L << 17;
constexpr int32_t RATE_TO_UPPER_HALF = 8;
// 128 / 100 in Q14.
constexpr int16_t CDEG_TO_128THS = 20972;
constexpr int16_t HALF_CIRCLE_CDEG = 18000;
constexpr int32_t CIRCLE_CDEG = 36000;
constexpr int16_t HALF_Q14 = 8192;

// The yaw damper's mean follows by a 1024th a slot: 2.05 s.
constexpr int32_t ONE_Q16 = 1L << 16;
constexpr int32_t WASHOUT_Q16 = ONE_Q16 / 1024;

/** A stick's deflection, -32766 to 32766. */
OUT_OF_LINE int16_t deflection_q15(Ticks stick) {
  const int16_t ticks = clamped16(difference_of(stick, NEUTRAL), FULL_STICK);
  return times_q14(static_cast<int16_t>(ticks * 32), STICK_TO_Q15);
}

/** The shorter way from an angle to one of at most 90 degrees. */
int16_t shorter_way_cdeg(int16_t to, int16_t from) {
  const int16_t way = static_cast<int16_t>(to - from);
  if (way > HALF_CIRCLE_CDEG) return static_cast<int16_t>(way - CIRCLE_CDEG);
  if (way < -HALF_CIRCLE_CDEG) return static_cast<int16_t>(way + CIRCLE_CDEG);
  return way;
}

int16_t to_128ths(int16_t cdeg) { return times_q14(cdeg, CDEG_TO_128THS); }

/** The Raspberry Pi demands bank, pitch and yaw rate. */
bool has_setpoint(const Demand& demand) {
  return demand.mode == (demand.is_failsafe ? Mode::RETURN : Mode::SETPOINT);
}

Ticks preset(uint16_t us) { return us_to_ticks(static_cast<int16_t>(us)); }

}  // namespace

FlightController::FlightController(const Profile& profile, const Gains& gains)
    : ZEROED_BASE(ControllerMemory) profile_(profile), gains_(gains) {
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) outputs_.ticks[channel] = NEUTRAL;
  outputs_.ticks[THROTTLE] = us_to_ticks(1000);
}

void FlightController::tune_one() {
  const uint8_t loop = tuned_loops_;
  if (loop == LOOPS) return;
  ++tuned_loops_;
  if (loop < RATE_LOOPS) {
    rate_[loop].tune(gains_->rate[loop]);
  } else {
    stabilize_[loop - RATE_LOOPS].tune(gains_->stabilize[loop - RATE_LOOPS]);
  }
}

Hold FlightController::hold_of(const Demand& demand) {
  if (!demand.is_imu_valid) return Hold::NOTHING;
  if (demand.is_failsafe) return Hold::ANGLES;
  if (demand.mode == Mode::RATE) return Hold::RATES;
  const bool is_level = demand.mode == Mode::FBW || demand.mode == Mode::SETPOINT;
  return is_level ? Hold::ANGLES : Hold::NOTHING;
}

/** From FBW to SETPOINT or into the circle the state is kept: the surfaces do not jump. */
void FlightController::engage(Hold hold) {
  if (hold == hold_) return;
  if (hold_ == Hold::NOTHING) {
    for (Pid& pid : rate_) pid.reset();
    has_steady_ = false;
  }
  for (Pid& pid : stabilize_) pid.reset();
  hold_ = hold;
}

const Outputs& FlightController::update(const Demand& demand,
                                                    const Attitude& attitude) {
  tune_one();
  engage(hold_of(demand));
  Ticks demands[OUTPUTS];
  pass_through(demand, demands);
  if (hold_ != Hold::NOTHING) hold_rates(demand, attitude, demands);
  demands[THROTTLE] = slewed(demand.throttle);
  to_servos(*profile_, demands, outputs_);
  return outputs_;
}

/** The throttle of a motor rises by the profile's limit, from the pulse before; it falls freely. */
Ticks FlightController::slewed(Ticks throttle) {
  const uint8_t step = profile_->throttle_slew();
  if (step == 0 || !profile_->has_motor) return throttle;
  Ticks most = outputs_.ticks[THROTTLE];
  if (++slots_to_slew_ == SLEW_SLOTS) {
    slots_to_slew_ = 0;
    most = static_cast<Ticks>(most + step);
  }
  return throttle < most ? throttle : most;
}

void FlightController::pass_through(const Demand& demand, Ticks* demands) const {
  if (demand.is_failsafe) {
    demands[AILERONS] = preset(profile_->preset_ailerons_us);
    demands[ELEVATOR] = preset(profile_->preset_elevator_us);
    demands[RUDDER] = preset(profile_->preset_rudder_us);
    return;
  }
  const Ticks* asked = demand.mode == Mode::OUTPUT ? demand.asked.outputs.ticks : demand.sticks;
  demands[AILERONS] = asked[AILERONS];
  demands[ELEVATOR] = asked[ELEVATOR];
  demands[RUDDER] = asked[RUDDER];
}

OUT_OF_LINE void FlightController::hold_rates(const Demand& demand, const Attitude& attitude,
                                              Ticks* demands) {
  const int16_t roll_16 = wanted_rate_16(AILERONS, demand, attitude);
  demands[AILERONS] = sum_of(NEUTRAL, deflection(ROLL, roll_16, attitude.roll_rate_16));
  int16_t pitch_16 = wanted_rate_16(ELEVATOR, demand, attitude);
  if (hold_ == Hold::ANGLES) pitch_16 = pitch_rate_in_turn_16(pitch_16, attitude);
  demands[ELEVATOR] = sum_of(NEUTRAL, deflection(PITCH, pitch_16, attitude.pitch_rate_16));
  int16_t yaw_16 = 0;
  if (demand.is_failsafe) {
    demands[RUDDER] = NEUTRAL;
  }
  if (has_setpoint(demand)) {
    yaw_16 = times_q15(demand.asked.setpoint.yaw_rate_cdeg_s, CDEG_TO_16THS);
  }
  const int16_t swinging = swinging_16(attitude.yaw_rate_16);
  demands[RUDDER] = sum_of(demands[RUDDER], deflection(YAW, yaw_16, swinging));
}

/** By the stick in RATE, otherwise by the Stabilize PID; `channel` is AILERONS or ELEVATOR. */
int16_t FlightController::wanted_rate_16(Channel channel, const Demand& demand,
                                                     const Attitude& attitude) {
  const bool is_roll = channel == AILERONS;
  if (hold_ == Hold::RATES) {
    const int16_t greatest_16 = (is_roll ? ROLL_STICK_DEG_S : PITCH_STICK_DEG_S) * 16;
    return times_q15(greatest_16, deflection_q15(demand.sticks[channel]));
  }
  const int16_t wanted_cdeg = wanted_angle_cdeg(channel, demand);
  const int16_t angle_cdeg = is_roll ? attitude.roll_cdeg : attitude.pitch_cdeg;
  const int16_t error = to_128ths(shorter_way_cdeg(wanted_cdeg, angle_cdeg));
  int16_t limit_deg_s = is_roll ? ROLL_RATE_LIMIT_DEG_S : PITCH_RATE_LIMIT_DEG_S;
  if (is_roll && attitude.cos_roll <= 0) limit_deg_s = INVERTED_ROLL_RATE_LIMIT_DEG_S;
  const int32_t rate =
      stabilize_[channel].update(error, to_128ths(angle_cdeg), limit_deg_s * RATE_TO_LIMIT);
  return upper_half(rate * RATE_TO_UPPER_HALF);
}

/**
 * The rate about the pitch axis that changes pitch by `wanted_16`, sixteenths of a deg/s. Banked,
 * the nose stays where it is only while it pitches with the turn: by the yaw rate times the tangent
 * of the bank, which beyond 60 degrees falls to 0 at 90. Beyond 90 degrees the elevator waits: it
 * would pull the nose down.
 */
int16_t FlightController::pitch_rate_in_turn_16(int16_t wanted_16, const Attitude& attitude) {
  const int16_t cosine = attitude.cos_roll;
  if (cosine <= 0) return 0;
  const int16_t sine = attitude.sin_roll;
  // Half the tangent, or twice sine times cosine, which meet at 60 degrees.
  const int16_t tangent = cosine < HALF_Q14 ? static_cast<int16_t>(times_q14(sine, cosine) * 2)
                                            : ratio_q14(static_cast<int16_t>(sine / 2), cosine);
  const int16_t turning_16 = times_q14(attitude.yaw_rate_16, tangent);
  return sum_of(times_q14(wanted_16, cosine), sum_of(turning_16, turning_16));
}

/** The failsafe's, the Raspberry Pi's or the stick's bank or pitch. */
int16_t FlightController::wanted_angle_cdeg(Channel channel,
                                                        const Demand& demand) const {
  const bool is_roll = channel == AILERONS;
  const bool is_asked = has_setpoint(demand);
  if (demand.is_failsafe && !is_asked) {
    return is_roll ? profile_->circle_bank_cdeg : profile_->glide_pitch_cdeg;
  }
  const int16_t asked = is_roll ? demand.asked.setpoint.roll_cdeg : demand.asked.setpoint.pitch_cdeg;
  const int16_t stick = deflection_q15(demand.sticks[channel]);
  const bool is_down = (is_asked ? asked : stick) < 0;
  const int16_t limit = is_roll   ? profile_->roll_limit_cdeg
                        : is_down ? profile_->pitch_down_limit_cdeg
                                  : profile_->pitch_up_limit_cdeg;
  return is_asked ? clamped16(asked, limit) : times_q15(limit, stick);
}

/** The yaw rate less its mean: the damper must not act on a steady turn. */
int16_t FlightController::swinging_16(int16_t yaw_rate_16) {
  if (!has_steady_) {
    has_steady_ = true;
    steady_ = yaw_rate_16 * ONE_Q16;
  }
  const int16_t swinging = difference_of(yaw_rate_16, upper_half(steady_));
  steady_ += swinging * WASHOUT_Q16;
  return swinging;
}

/** The output of a Rate PID, ticks. */
OUT_OF_LINE Ticks FlightController::deflection(uint8_t axis, int16_t wanted_16, int16_t rate_16) {
  const int32_t units = rate_[axis].update(difference_of(wanted_16, rate_16), rate_16, RATE_LIMIT);
  return upper_half(units * UNIT_TO_UPPER_HALF);
}

}  // namespace raspilot
