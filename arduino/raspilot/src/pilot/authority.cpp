#include "authority.h"

namespace raspilot {

namespace {

constexpr uint16_t LOSS_UNITS = units_at_least(500);  // A lost receiver: failsafe after this.
// More than one frame of any receiver (22 ms).
constexpr uint16_t RETURN_UNITS = units_at_least(30);
// Three frames of any receiver.
constexpr uint16_t LEFT_UNITS = units_at_least(70);
constexpr uint16_t LATCH_UNITS = units_at_least(5000);
constexpr uint16_t OUTPUT_TIMEOUT_UNITS = units_at_most(250);
constexpr uint16_t MAX_SETPOINT_MS = 250;
constexpr uint16_t ASKED_OUTPUT_UNITS = units_at_least(500);
constexpr uint16_t VETO_TIMEOUT_UNITS = units_at_least(1000);
constexpr uint16_t LOW_LONG_ENOUGH_UNITS = units_at_least(2000);
// A receiver needs that long to link again after a reset in flight.
constexpr uint16_t RELINK_S = 5;
constexpr uint32_t MAX_ORIENTATION_AGE_US = 100000;
constexpr Ticks LOW_THROTTLE = us_to_ticks(1050);
constexpr Ticks MOTOR_OFF = us_to_ticks(1000);

// A pilot whose receiver is back takes over after this, by a fifth of a stick's travel.
constexpr uint16_t BACK_UNITS = units_at_least(1000);
constexpr Ticks TAKE_OVER = us_to_ticks(200);

char letter_of(Mode mode) { return static_cast<char>(mode); }

}  // namespace

Authority::Authority(const Profile& profile, const PwmReader& receiver)
    : profile_(profile), receiver_(receiver) {}

void Authority::update(bool is_imu_valid, bool is_calibrating, bool is_profile_broken,
                       uint32_t now_us) {
  uint8_t vetoes = 0;
  if (!is_imu_valid) vetoes |= VETO_IMU_INVALID;
  if (is_calibrating) vetoes |= VETO_CALIBRATING;
  if (is_profile_broken) vetoes |= VETO_PROFILE_INVALID;
  slot_vetoes_ = vetoes;
  const uint16_t now_units = to_units(now_us);
  const uint16_t passed_units = static_cast<uint16_t>(now_units - updated_at_);
  updated_at_ = now_units;
  for (Lifetime& life : timeouts_) life.pass(passed_units);
  follow_receiver(passed_units);
}

void Authority::follow_receiver(uint16_t passed_units) {
  const bool is_valid = receiver_->validity() == ALL_INPUTS;
  const Ticks lost_throttle = us_to_ticks(static_cast<int16_t>(profile_->throttle_lost_us));
  const bool is_own_failsafe = is_valid && receiver_->pulse(THROTTLE) < lost_throttle;
  if (is_valid && !is_own_failsafe) {
    rx_ok_timer_.pass(passed_units);
  } else {
    rx_ok_timer_.start();
  }
  if (rx_ok_timer_.units() < RETURN_UNITS) slot_vetoes_ |= VETO_RECEIVER_INVALID;
  follow_failsafe(is_own_failsafe, passed_units);
  if (!has_receiver()) {
    arming_.reset();
    throttle_low_.start();
    return;
  }
  switch_.update(receiver_->pulse(AUX1));
  if (is_auto()) {
    away_.start();
  } else {
    // One bad pulse suspends the selected mode but does not end it.
    away_.pass(passed_units);
    if (away_.units() >= LEFT_UNITS) requested_mode_ = 0;
    timeouts_[ASKED].end();
    end_demands();
  }
  if (is_throttle_low()) {
    throttle_low_.pass(passed_units);
    is_latched_ = false;
  } else {
    throttle_low_.start();
  }
  follow_arming(passed_units);
}

OUT_OF_LINE void Authority::follow_failsafe(bool is_own_failsafe, uint16_t passed_units) {
  if (has_receiver()) {
    if (is_failsafe_ && timeouts_[RETURNING].is_running() && !is_pilot_back(passed_units)) return;
    is_failsafe_ = false;
    timeouts_[RETURNING].end();
    motor_off_.start();
    back_.start();
    lost_.start();
    return;
  }
  back_.start();
  if (!was_heard()) return;
  lost_.pass(passed_units);
  if (is_own_failsafe || lost_.units() >= LOSS_UNITS) is_failsafe_ = true;
  if (!is_failsafe_) return;
  end_demands();
  if (lost_.units() > LATCH_UNITS) is_latched_ = true;
  if (timeouts_[RETURNING].is_running() && may_use_motor()) {
    motor_off_.start();
  } else {
    motor_off_.pass(passed_units);
  }
}

/** In a return flight: the mere return of pulses gives the pilot nothing. */
bool Authority::is_pilot_back(uint16_t passed_units) {
  const bool was_long = back_.units() >= BACK_UNITS;
  back_.pass(passed_units);
  bool has_moved = false;
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    const Ticks pulse = receiver_->pulse(static_cast<Channel>(channel));
    if (!was_long) rest_[channel] = pulse;
    const Ticks way = static_cast<Ticks>(pulse - rest_[channel]);
    if (way > TAKE_OVER || way < -TAKE_OVER) has_moved = true;
  }
  return has_moved || (was_long && !is_auto());
}

/** A motor that stood for 5 s of failsafe does not start again. */
bool Authority::may_use_motor() const {
  return profile_->may_return_with_motor() && motor_off_.units() <= LATCH_UNITS;
}

void Authority::follow_arming(uint16_t passed_units) {
  const ArmingSwitch::Event event = arming_.update(receiver_->pulse(AUX2), passed_units);
  if (event == ArmingSwitch::FELL) is_armed_ = false;
  if (event == ArmingSwitch::ROSE && vetoes() == 0) is_armed_ = true;
}

Mode Authority::mode() const {
  const bool is_asked = requested_mode_ == letter_of(Mode::OUTPUT) && timeouts_[ASKED].is_running();
  return is_asked && has_imu() && has_receiver() ? Mode::OUTPUT : flown_mode();
}

Mode Authority::flown_mode() const {
  if (!has_imu()) return Mode::ACRO;
  const uint8_t position = switch_.position();
  if (is_failsafe_ && timeouts_[RETURNING].is_running()) return Mode::RETURN;
  if (is_failsafe_ || position == SWITCH_UNKNOWN) return Mode::FBW;
  const char letter = profile_->switch_modes[position];
  if (letter == letter_of(Mode::ACRO)) return Mode::ACRO;
  if (letter == letter_of(Mode::RATE)) return Mode::RATE;
  if (letter != 'A') return Mode::FBW;
  if (has_receiver() && timeouts_[OUTPUT].is_running()) return Mode::OUTPUT;
  if (has_receiver() && timeouts_[DEMAND].is_running()) return Mode::SETPOINT;
  return requested_mode_ == letter_of(Mode::RATE) ? Mode::RATE : Mode::FBW;
}

bool Authority::is_auto() const {
  const uint8_t position = switch_.position();
  return position != SWITCH_UNKNOWN && profile_->switch_modes[position] == 'A';
}

bool Authority::is_in_flight(uint16_t uptime_s) const {
  return is_armed_ || (!profile_->has_motor && (was_heard() || uptime_s < RELINK_S));
}

bool Authority::is_throttle_low() const { return receiver_->pulse(THROTTLE) < LOW_THROTTLE; }

uint8_t Authority::vetoes() const {
  uint8_t vetoes = slot_vetoes_;
  if (profile_->has_motor && !is_throttle_low()) vetoes |= VETO_THROTTLE_NOT_LOW;
  if (!arming_.is_high()) vetoes |= VETO_AUX2_LOW;
  if (timeouts_[PI_VETO].is_running()) vetoes |= VETO_RASPBERRY_PI;
  return vetoes;
}

OUT_OF_LINE Ticks Authority::throttle() const {
  if (profile_->has_motor && !is_armed_) return MOTOR_OFF;
  const Mode mode = flown_mode();
  uint16_t demand_us = 0;
  if (is_failsafe_ || is_latched_ || !was_heard()) {
    demand_us = profile_->throttle_failsafe_us;
    if (mode == Mode::RETURN && may_use_motor() && asked_.setpoint.throttle_us != 0) {
      demand_us = asked_.setpoint.throttle_us;
    }
    return us_to_ticks(static_cast<int16_t>(demand_us));
  }
  if (mode == Mode::SETPOINT) demand_us = asked_.setpoint.throttle_us;
  if (mode == Mode::OUTPUT) demand_us = ticks_to_us(asked_.outputs.ticks[THROTTLE]);
  return demand_us != 0 ? us_to_ticks(static_cast<int16_t>(demand_us)) : receiver_->pulse(THROTTLE);
}

Reason Authority::arm() {
  const uint8_t against = vetoes();
  if (against & VETO_THROTTLE_NOT_LOW) return Reason::THROTTLE_NOT_LOW;
  if (against & VETO_RECEIVER_INVALID) return Reason::RECEIVER_INVALID;
  if (against & VETO_IMU_INVALID) return Reason::IMU_INVALID;
  if (against != 0) return Reason::VETO;
  is_armed_ = true;
  return Reason::NONE;
}

Reason Authority::disarm() {
  if (is_armed_ && profile_->has_motor && throttle_low_.units() < LOW_LONG_ENOUGH_UNITS) {
    return has_receiver() ? Reason::THROTTLE_NOT_LOW : Reason::RECEIVER_INVALID;
  }
  is_armed_ = false;
  return Reason::NONE;
}

Reason Authority::request_mode(char letter) {
  const Mode mode = static_cast<Mode>(letter);
  if (mode != Mode::RATE && mode != Mode::FBW && mode != Mode::SETPOINT && mode != Mode::OUTPUT) {
    return Reason::OUT_OF_RANGE;
  }
  if (!is_auto()) return Reason::NOT_AT_AUTO;
  if (!has_receiver() || is_failsafe_) return Reason::RECEIVER_INVALID;
  if (mode == Mode::OUTPUT && !has_imu()) return Reason::IMU_INVALID;
  requested_mode_ = letter;
  timeouts_[ASKED].start(ASKED_OUTPUT_UNITS);
  if (mode != Mode::OUTPUT) timeouts_[OUTPUT].end();
  if (mode != Mode::SETPOINT) timeouts_[DEMAND].end();
  return Reason::NONE;
}

Reason Authority::authority_for(Mode mode) const {
  if (!is_auto()) return Reason::NOT_AT_AUTO;
  if (requested_mode_ != 0 && requested_mode_ != letter_of(mode)) return Reason::NOT_AT_AUTO;
  // In a return flight with a receiver a Setpoint would take the place of the return set-point.
  if (!has_receiver() || is_failsafe_) return Reason::RECEIVER_INVALID;
  if (!has_imu()) return Reason::IMU_INVALID;
  if (profile_->has_motor && !is_armed_) return Reason::VETO;
  return Reason::NONE;
}

Reason Authority::accept_outputs(const uint16_t* pulses_us, uint32_t age_us) {
  const Reason reason = authority_for(Mode::OUTPUT);
  if (reason != Reason::NONE) return reason;
  if (age_us > MAX_ORIENTATION_AGE_US) return Reason::TOO_OLD;
  for (uint8_t i = 0; i < OUTPUTS; ++i) {
    asked_.outputs.ticks[i] = us_to_ticks(static_cast<int16_t>(pulses_us[i]));
  }
  // They share memory with a Setpoint, which must not be read from here on.
  timeouts_[DEMAND].end();
  timeouts_[OUTPUT].start(OUTPUT_TIMEOUT_UNITS);
  return Reason::NONE;
}

Reason Authority::accept_setpoint(const Setpoint& setpoint, uint16_t lifetime_ms) {
  const Reason reason = authority_for(Mode::SETPOINT);
  if (reason != Reason::NONE) return reason;
  follow(DEMAND, setpoint, lifetime_ms);
  return Reason::NONE;
}

Reason Authority::accept_return(const Setpoint& setpoint, uint16_t lifetime_ms) {
  if (!profile_->may_pi_fly()) return Reason::NOT_ALLOWED;
  if (!is_failsafe_) return Reason::NOT_IN_FAILSAFE;
  if (!has_imu()) return Reason::IMU_INVALID;
  if (slot_vetoes_ & VETO_PROFILE_INVALID) return Reason::VETO;
  follow(RETURNING, setpoint, lifetime_ms);
  return Reason::NONE;
}

OUT_OF_LINE void Authority::follow(Life life, const Setpoint& setpoint, uint16_t lifetime_ms) {
  asked_.setpoint = setpoint;
  const uint16_t bounded_ms = lifetime_ms < MAX_SETPOINT_MS ? lifetime_ms : MAX_SETPOINT_MS;
  // Rather a unit too short than one too long.
  timeouts_[life].start(static_cast<uint16_t>(bounded_ms * 31 / 32));
  timeouts_[OUTPUT].end();
}

void Authority::accept_veto(bool is_vetoed) {
  timeouts_[PI_VETO].start(is_vetoed ? VETO_TIMEOUT_UNITS : 0);
}

void Authority::end_demands() {
  timeouts_[OUTPUT].end();
  timeouts_[DEMAND].end();
}

AuthorityState Authority::state() const {
  return AuthorityState{is_armed_, switch_.position(), requested_mode_, is_latched_, is_failsafe_};
}

void Authority::restore(const AuthorityState& state, uint32_t now_us) {
  is_armed_ = state.is_armed;
  switch_.restore(state.switch_position);
  requested_mode_ = state.requested_mode;
  is_latched_ = state.is_throttle_latched;
  if (is_latched_) motor_off_.pass(65535);
  is_failsafe_ = state.is_failsafe;
  updated_at_ = to_units(now_us);
}

}  // namespace raspilot
