#include "authority.h"

namespace raspilot {

namespace {

constexpr uint16_t LOSS_MS = 500;
// More than one frame of any receiver (22 ms).
constexpr uint16_t RETURN_MS = 30;
constexpr uint16_t LATCH_MS = 5000;
constexpr uint16_t OUTPUT_LIVES_MS = 250;
constexpr uint16_t ASKED_OUTPUT_MS = 500;
constexpr uint16_t VETO_LIVES_MS = 1000;
constexpr uint16_t LOW_LONG_ENOUGH_MS = 2000;
constexpr uint32_t OLDEST_ORIENTATION_US = 100000;
constexpr uint32_t LONGEST_PASS_US = 130000;
constexpr Ticks LOW_THROTTLE = us_to_ticks(1050);
constexpr Ticks MOTOR_OFF = us_to_ticks(1000);

bool is_pulse(uint16_t us) { return us >= 1000 && us <= 2000; }
bool is_throttle_demand(uint16_t us) { return us == 0 || is_pulse(us); }
char letter_of(Mode mode) { return static_cast<char>(mode); }

}  // namespace

Authority::Authority(const Profile& profile, const PwmReader& receiver)
    : profile_(profile), receiver_(receiver), setpoint_(), asked_outputs_() {}

void Authority::update(bool is_imu_valid, bool is_calibrating, bool is_profile_broken,
                       uint32_t now_us) {
  is_imu_valid_ = is_imu_valid;
  is_calibrating_ = is_calibrating;
  is_profile_broken_ = is_profile_broken;
  const uint16_t passed_ms = pass(now_us);
  asked_.pass(passed_ms);
  outputs_.pass(passed_ms);
  demand_.pass(passed_ms);
  veto_.pass(passed_ms);
  follow_receiver(passed_ms);
}

uint16_t Authority::pass(uint32_t now_us) {
  uint32_t passed_us = now_us - updated_us_;
  updated_us_ = now_us;
  // The watchdog lets no slot be longer; the first one is.
  if (passed_us > LONGEST_PASS_US) passed_us = LONGEST_PASS_US;
  passed_us += rest_us_;
  uint16_t passed_ms = 0;
  // Mostly twice: a division takes longer.
  for (; passed_us >= 1000; passed_us -= 1000) ++passed_ms;
  rest_us_ = static_cast<uint16_t>(passed_us);
  return passed_ms;
}

void Authority::follow_receiver(uint16_t passed_ms) {
  const bool is_valid = receiver_.validity() == ALL_INPUTS;
  const Ticks lost_throttle = us_to_ticks(static_cast<int16_t>(profile_.throttle_lost_us));
  const bool is_own_failsafe = is_valid && receiver_.pulse(THROTTLE) < lost_throttle;
  if (is_valid && !is_own_failsafe) {
    sound_.pass(passed_ms);
  } else {
    sound_.start();
  }
  has_receiver_ = sound_.ms() >= RETURN_MS;
  follow_failsafe(is_own_failsafe, passed_ms);
  if (!has_receiver_) {
    arming_.forget();
    throttle_low_.start();
    return;
  }
  switch_.take(receiver_.pulse(AUX1));
  if (!is_auto()) {
    asked_mode_ = 0;
    asked_.end();
    end_demands();
  }
  if (is_throttle_low()) {
    throttle_low_.pass(passed_ms);
    is_latched_ = false;
  } else {
    throttle_low_.start();
  }
  follow_arming(passed_ms);
}

void Authority::follow_failsafe(bool is_own_failsafe, uint16_t passed_ms) {
  if (has_receiver_) {
    is_failsafe_ = false;
    lost_.start();
    return;
  }
  if (!was_heard()) return;
  lost_.pass(passed_ms);
  if (is_own_failsafe || lost_.ms() >= LOSS_MS) is_failsafe_ = true;
  if (!is_failsafe_) return;
  end_demands();
  if (lost_.ms() > LATCH_MS) is_latched_ = true;
}

void Authority::follow_arming(uint16_t passed_ms) {
  const ArmingSwitch::Event event = arming_.take(receiver_.pulse(AUX2), passed_ms);
  if (event == ArmingSwitch::FELL) is_armed_ = false;
  if (event == ArmingSwitch::ROSE && vetoes() == 0) is_armed_ = true;
}

Mode Authority::mode() const {
  const bool is_asked = asked_mode_ == letter_of(Mode::OUTPUT) && asked_.lives();
  return is_asked && is_imu_valid_ && has_receiver_ ? Mode::OUTPUT : flown_mode();
}

Mode Authority::flown_mode() const {
  if (!is_imu_valid_) return Mode::ACRO;
  const uint8_t position = switch_.position();
  if (is_failsafe_ || position == SWITCH_UNKNOWN) return Mode::FBW;
  const char letter = profile_.switch_modes[position];
  if (letter == letter_of(Mode::ACRO)) return Mode::ACRO;
  if (letter == letter_of(Mode::RATE)) return Mode::RATE;
  if (letter != 'A') return Mode::FBW;
  if (has_receiver_ && outputs_.lives()) return Mode::OUTPUT;
  if (has_receiver_ && demand_.lives()) return Mode::SETPOINT;
  return asked_mode_ == letter_of(Mode::RATE) ? Mode::RATE : Mode::FBW;
}

bool Authority::is_auto() const {
  const uint8_t position = switch_.position();
  return position != SWITCH_UNKNOWN && profile_.switch_modes[position] == 'A';
}

bool Authority::is_throttle_low() const { return receiver_.pulse(THROTTLE) < LOW_THROTTLE; }

uint8_t Authority::vetoes() const {
  uint8_t vetoes = 0;
  if (profile_.has_motor && !is_throttle_low()) vetoes |= VETO_THROTTLE;
  if (!has_receiver_) vetoes |= VETO_RECEIVER;
  if (!is_imu_valid_) vetoes |= VETO_IMU;
  if (!arming_.is_high()) vetoes |= VETO_AUX2;
  if (veto_.lives()) vetoes |= VETO_RASPBERRY;
  if (is_calibrating_) vetoes |= VETO_CALIBRATING;
  if (is_profile_broken_) vetoes |= VETO_PROFILE;
  return vetoes;
}

Ticks Authority::throttle() const {
  if (profile_.has_motor && !is_armed_) return MOTOR_OFF;
  if (is_failsafe_ || is_latched_ || !was_heard()) {
    return us_to_ticks(static_cast<int16_t>(profile_.throttle_failsafe_us));
  }
  const Mode mode = flown_mode();
  uint16_t demand_us = 0;
  if (mode == Mode::SETPOINT) demand_us = setpoint_.throttle_us;
  if (mode == Mode::OUTPUT) demand_us = ticks_to_us(asked_outputs_.ticks[THROTTLE]);
  return demand_us != 0 ? us_to_ticks(static_cast<int16_t>(demand_us)) : receiver_.pulse(THROTTLE);
}

Reason Authority::arm(uint32_t) {
  const uint8_t against = vetoes();
  if (against & VETO_THROTTLE) return Reason::THROTTLE_NOT_LOW;
  if (against & VETO_RECEIVER) return Reason::RECEIVER_INVALID;
  if (against & VETO_IMU) return Reason::IMU_INVALID;
  if (against != 0) return Reason::VETO;
  is_armed_ = true;
  return Reason::NONE;
}

Reason Authority::disarm(uint32_t) {
  if (is_armed_ && profile_.has_motor && throttle_low_.ms() < LOW_LONG_ENOUGH_MS) {
    return has_receiver_ ? Reason::THROTTLE_NOT_LOW : Reason::RECEIVER_INVALID;
  }
  is_armed_ = false;
  return Reason::NONE;
}

Reason Authority::ask_mode(char letter, uint32_t) {
  const Mode mode = static_cast<Mode>(letter);
  if (mode != Mode::RATE && mode != Mode::FBW && mode != Mode::SETPOINT && mode != Mode::OUTPUT) {
    return Reason::OUT_OF_RANGE;
  }
  if (!is_auto()) return Reason::NOT_AUTO;
  if (!has_receiver_) return Reason::RECEIVER_INVALID;
  if (mode == Mode::OUTPUT && !is_imu_valid_) return Reason::IMU_INVALID;
  asked_mode_ = letter;
  asked_.start(ASKED_OUTPUT_MS);
  if (mode != Mode::OUTPUT) outputs_.end();
  if (mode != Mode::SETPOINT) demand_.end();
  return Reason::NONE;
}

Reason Authority::authority_for(Mode mode) const {
  if (!is_auto()) return Reason::NOT_AUTO;
  if (asked_mode_ != 0 && asked_mode_ != letter_of(mode)) return Reason::NOT_AUTO;
  if (!has_receiver_) return Reason::RECEIVER_INVALID;
  if (!is_imu_valid_) return Reason::IMU_INVALID;
  if (profile_.has_motor && !is_armed_) return Reason::VETO;
  return Reason::NONE;
}

Reason Authority::take_outputs(const uint16_t* pulses_us, uint32_t age_us, uint32_t) {
  for (uint8_t i = 0; i < OUTPUTS; ++i) {
    const uint16_t us = pulses_us[i];
    if (!(i == THROTTLE ? is_throttle_demand(us) : is_pulse(us))) return Reason::OUT_OF_RANGE;
  }
  const Reason reason = authority_for(Mode::OUTPUT);
  if (reason != Reason::NONE) return reason;
  if (age_us > OLDEST_ORIENTATION_US) return Reason::TOO_OLD;
  for (uint8_t i = 0; i < OUTPUTS; ++i) {
    asked_outputs_.ticks[i] = us_to_ticks(static_cast<int16_t>(pulses_us[i]));
  }
  // It outlives any older Setpoint, whose lifetime is no longer.
  outputs_.start(OUTPUT_LIVES_MS);
  return Reason::NONE;
}

Reason Authority::take_setpoint(const Setpoint& setpoint, uint16_t lifetime_ms, uint32_t) {
  if (setpoint.roll_cdeg < -18000 || setpoint.roll_cdeg > 18000 || setpoint.pitch_cdeg < -9000 ||
      setpoint.pitch_cdeg > 9000 || !is_throttle_demand(setpoint.throttle_us) ||
      lifetime_ms < 1 || lifetime_ms > OUTPUT_LIVES_MS) {
    return Reason::OUT_OF_RANGE;
  }
  const Reason reason = authority_for(Mode::SETPOINT);
  if (reason != Reason::NONE) return reason;
  setpoint_ = setpoint;
  demand_.start(lifetime_ms);
  outputs_.end();
  return Reason::NONE;
}

void Authority::take_veto(bool is_vetoed, uint32_t) {
  veto_.start(is_vetoed ? VETO_LIVES_MS : 0);
}

void Authority::end_demands() {
  outputs_.end();
  demand_.end();
}

AuthorityState Authority::state() const {
  return AuthorityState{is_armed_, switch_.position(), asked_mode_, is_latched_, is_failsafe_};
}

void Authority::restore(const AuthorityState& state, uint32_t now_us) {
  is_armed_ = state.is_armed;
  switch_.restore(state.switch_position);
  asked_mode_ = state.asked_mode;
  is_latched_ = state.is_throttle_latched;
  is_failsafe_ = state.is_failsafe;
  updated_us_ = now_us;
}

}  // namespace raspilot
