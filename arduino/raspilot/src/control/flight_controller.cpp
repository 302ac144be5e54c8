#include "flight_controller.h"

#include "fixed_point.h"
#include "servo_stage.h"

namespace raspilot {

namespace {

constexpr Ticks NEUTRAL = us_to_ticks(1500);
constexpr int16_t FULL_STICK = 1000;
// Thirty-seconds of a full stick's 1000 ticks to Q15: 32.766 in Q14 less five bits.
constexpr int16_t STICK_TO_Q15 = 16776;
// A hundredth of a degree per second in sixteenths, Q15.
constexpr int16_t CDEG_TO_16THS = 5243;

/** A stick's deflection, -32767 to 32767. */
int16_t deflection_q15(Ticks stick) {
  const int16_t ticks = clamped16(difference_of(stick, NEUTRAL), FULL_STICK);
  return times_q14(static_cast<int16_t>(ticks * 32), STICK_TO_Q15);
}

/** A wanted pitch within the limits for up and down. */
int16_t limited_pitch(const Profile& profile, int16_t cdeg) {
  const int16_t lowest = static_cast<int16_t>(-profile.pitch_down_limit_cdeg);
  if (cdeg > profile.pitch_up_limit_cdeg) return profile.pitch_up_limit_cdeg;
  return cdeg < lowest ? lowest : cdeg;
}

Ticks preset(uint16_t us) { return us_to_ticks(static_cast<int16_t>(us)); }

}  // namespace

constexpr uint8_t FlightController::LOOPS;

FlightController::FlightController(const Profile& profile, const Gains& gains)
    : profile_(profile),
      gains_(gains),
      roll_(ROLL_RATE_LIMIT_DEG_S),
      pitch_(PITCH_RATE_LIMIT_DEG_S) {
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) outputs_.ticks[channel] = NEUTRAL;
  outputs_.ticks[THROTTLE] = us_to_ticks(1000);
}

void FlightController::tune_one() {
  switch (loops_to_tune_) {
    case 0:
      return;
    case 1:
      yaw_.tune(gains_.rate[2]);
      break;
    case 2:
      pitch_.tune_stabilize(gains_.stabilize[1]);
      break;
    case 3:
      pitch_.tune_rate(gains_.rate[1]);
      break;
    case 4:
      roll_.tune_stabilize(gains_.stabilize[0]);
      break;
    default:
      roll_.tune_rate(gains_.rate[0]);
  }
  --loops_to_tune_;
}

FlightController::Hold FlightController::hold_of(const Demand& demand) {
  if (!demand.is_imu_valid) return Hold::NOTHING;
  if (demand.is_failsafe) return Hold::ANGLES;
  switch (demand.mode) {
    case Mode::RATE:
      return Hold::RATES;
    case Mode::FBW:
    case Mode::SETPOINT:
      return Hold::ANGLES;
    default:
      return Hold::NOTHING;
  }
}

/** From FBW to SETPOINT or into the circle nothing is forgotten: the surfaces do not jump. */
void FlightController::engage(Hold hold) {
  if (hold == hold_) return;
  if (hold_ == Hold::NOTHING) {
    roll_.reset_rate();
    pitch_.reset_rate();
    yaw_.reset();
  }
  roll_.reset_stabilize();
  pitch_.reset_stabilize();
  hold_ = hold;
}

const Outputs& FlightController::update(const Demand& demand, const Attitude& attitude) {
  tune_one();
  engage(hold_of(demand));
  Ticks demands[OUTPUTS];
  switch (hold_) {
    case Hold::NOTHING:
      pass_through(demand, demands);
      break;
    case Hold::RATES:
      hold_rates(demand, attitude, demands);
      break;
    case Hold::ANGLES:
      hold_angles(demand, attitude, demands);
      break;
  }
  demands[THROTTLE] = demand.throttle;
  to_servos(profile_, demands, outputs_);
  return outputs_;
}

void FlightController::pass_through(const Demand& demand, Ticks* demands) const {
  if (demand.is_failsafe) {
    demands[AILERONS] = preset(profile_.preset_ailerons_us);
    demands[ELEVATOR] = preset(profile_.preset_elevator_us);
    demands[RUDDER] = preset(profile_.preset_rudder_us);
    return;
  }
  const Ticks* asked = demand.mode == Mode::OUTPUT ? demand.asked.ticks : demand.sticks;
  demands[AILERONS] = asked[AILERONS];
  demands[ELEVATOR] = asked[ELEVATOR];
  demands[RUDDER] = asked[RUDDER];
}

void FlightController::hold_rates(const Demand& demand, const Attitude& attitude, Ticks* demands) {
  const int16_t roll_16 = times_q15(ROLL_STICK_DEG_S * 16, deflection_q15(demand.sticks[AILERONS]));
  const int16_t pitch_16 = times_q15(PITCH_STICK_DEG_S * 16, deflection_q15(demand.sticks[ELEVATOR]));
  demands[AILERONS] = sum_of(NEUTRAL, roll_.hold_rate(roll_16, attitude.roll_rate_16));
  demands[ELEVATOR] = sum_of(NEUTRAL, pitch_.hold_rate(pitch_16, attitude.pitch_rate_16));
  demands[RUDDER] = sum_of(demand.sticks[RUDDER], yaw_.damp(0, attitude.yaw_rate_16));
}

void FlightController::hold_angles(const Demand& demand, const Attitude& attitude, Ticks* demands) {
  int16_t roll_cdeg;
  int16_t pitch_cdeg;
  int16_t yaw_16 = 0;
  Ticks rudder = demand.sticks[RUDDER];
  if (demand.is_failsafe) {
    roll_cdeg = profile_.circle_bank_cdeg;
    pitch_cdeg = profile_.glide_pitch_cdeg;
    rudder = NEUTRAL;
  } else if (demand.mode == Mode::SETPOINT) {
    roll_cdeg = demand.setpoint.roll_cdeg;
    pitch_cdeg = demand.setpoint.pitch_cdeg;
    yaw_16 = times_q15(demand.setpoint.yaw_rate_cdeg_s, CDEG_TO_16THS);
  } else {
    const int16_t elevator = deflection_q15(demand.sticks[ELEVATOR]);
    const int16_t pitch_limit =
        elevator < 0 ? profile_.pitch_down_limit_cdeg : profile_.pitch_up_limit_cdeg;
    roll_cdeg = times_q15(profile_.roll_limit_cdeg, deflection_q15(demand.sticks[AILERONS]));
    pitch_cdeg = times_q15(pitch_limit, elevator);
  }
  if (!demand.is_failsafe) {
    roll_cdeg = clamped16(roll_cdeg, profile_.roll_limit_cdeg);
    pitch_cdeg = limited_pitch(profile_, pitch_cdeg);
  }
  demands[AILERONS] = sum_of(
      NEUTRAL, roll_.hold_angle(roll_cdeg, attitude.roll_cdeg, attitude.roll_rate_16));
  demands[ELEVATOR] = sum_of(
      NEUTRAL, pitch_.hold_angle(pitch_cdeg, attitude.pitch_cdeg, attitude.pitch_rate_16));
  demands[RUDDER] = sum_of(rudder, yaw_.damp(yaw_16, attitude.yaw_rate_16));
}

}  // namespace raspilot
