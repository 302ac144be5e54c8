#include "forwarder.h"

#include "../core/autopilot.h"
#include "../core/compiler.h"
#include "status.h"

namespace raspilot {

namespace {

// Of 10 bits a byte 70 % at most; the status, with 6 bytes around it, goes five times a second.
constexpr uint32_t LOAD_BYTES_S = RASPILOT_BAUD / 10 * 7 / 10;
constexpr uint32_t STATUS_BYTES_S = (STATUS_SIZE + 6) * 5;
constexpr uint32_t STREAMED_BYTES = 19 + 32 + 14;
constexpr uint32_t MIN_PERIOD_US = STREAMED_BYTES * 1000000UL / (LOAD_BYTES_S - STATUS_BYTES_S);
constexpr uint8_t STEP_BITS = 5;

/** Steps that last at least `us`. */
constexpr uint16_t steps_of(uint32_t us) {
  return static_cast<uint16_t>((us + (1 << STEP_BITS) - 1) >> STEP_BITS);
}

constexpr uint16_t MIN_PERIOD = steps_of(MIN_PERIOD_US);
constexpr uint16_t PERIOD = steps_of(MIN_PERIOD_US > 20000 ? MIN_PERIOD_US : 20000);
constexpr uint16_t STATUS_PERIOD = steps_of(200000);
constexpr uint8_t MAX_AGE_UNITS = 100;
constexpr uint8_t ORIENTATION_SIZE = 26;

}  // namespace

constexpr uint32_t Forwarder::NEVER;

OUT_OF_LINE Forwarder::Steps Forwarder::to_steps(uint32_t time_us) {
  return static_cast<Steps>(time_us >> STEP_BITS);
}

OUT_OF_LINE void Forwarder::start(uint32_t now_us) {
  if (is_started_) return;
  is_started_ = true;
  for (Steps& due : due_) due = to_steps(now_us);
}

OUT_OF_LINE bool Forwarder::send_next(uint32_t now_us) {
  if (!is_started_) return false;
  const Steps now = to_steps(now_us);
  for (uint8_t tried = 0; tried < STREAMS; ++tried) {
    const uint8_t stream = next_;
    const bool is_now = is_due(stream, now);
    // A stream that does not fit stays due and is sent with newer values; nothing overtakes it.
    if (is_now && !send(stream, now_us)) return false;
    next_ = static_cast<uint8_t>((stream + 1) % STREAMS);
    if (!is_now) continue;
    const Steps each = period(stream);
    due_[stream] = static_cast<Steps>(due_[stream] + each);
    if (is_due(stream, now)) due_[stream] = static_cast<Steps>(now + each);
    return true;
  }
  return false;
}

OUT_OF_LINE Forwarder::Steps Forwarder::period(uint8_t stream) const {
  if (stream == STATUS_STREAM) return STATUS_PERIOD;
  if (period_ms_ == 0) return PERIOD;
  // A millisecond is 31 1/4 steps.
  const Steps asked = static_cast<Steps>(period_ms_ * 31 + period_ms_ / 4);
  const Mode mode = autopilot_->authority.mode();
  const bool is_consumed = mode == Mode::OUTPUT || mode == Mode::SETPOINT || mode == Mode::RETURN;
  if (is_consumed && stream != OUTPUTS_STREAM && asked > PERIOD) return PERIOD;
  return asked < MIN_PERIOD ? MIN_PERIOD : asked;
}

OUT_OF_LINE bool Forwarder::is_due(uint8_t stream, Steps now) {
  const int16_t left = static_cast<int16_t>(static_cast<Steps>(due_[stream] - now));
  if (left <= 0) return true;
  // A shorter period holds immediately, not after the long one that was running.
  const Steps most = period(stream);
  if (static_cast<Steps>(left) > most) due_[stream] = static_cast<Steps>(now + most);
  return false;
}

/** Sends it, or has nothing to send; false when it does not fit. */
bool Forwarder::send(uint8_t stream, uint32_t now_us) {
  switch (stream) {
    case INPUTS_STREAM: return send_inputs();
    case ORIENTATION_STREAM:
      // An invalid attitude is not sent: receivers see the last one age.
      return !autopilot_->attitude.is_valid() || send_orientation(now_us);
    case OUTPUTS_STREAM: return send_outputs();
    default: return send_status(now_us);
  }
}

bool Forwarder::send_inputs() {
  if (!autopilot_->link.begin('i', 2 * INPUTS + 1)) return false;
  const PwmReader& receiver = autopilot_->receiver;
  const uint8_t validity = receiver.validity();
  for (uint8_t channel = 0; channel < INPUTS; ++channel) {
    const Channel each = static_cast<Channel>(channel);
    // A pulse out of range is sent unchanged, so that it can be diagnosed.
    const bool is_good = (validity >> channel & 1) != 0;
    Link::Frame::u16(is_good ? ticks_to_us(receiver.pulse(each)) : receiver.measured_us(each));
  }
  Link::Frame::u8(validity);
  autopilot_->link.end();
  return true;
}

bool Forwarder::send_outputs() {
  if (!autopilot_->link.begin('r', 2 * OUTPUTS)) return false;
  for (const Ticks ticks : autopilot_->controller.outputs().ticks) {
    Link::Frame::u16(ticks_to_us(ticks));
  }
  autopilot_->link.end();
  return true;
}

bool Forwarder::send_orientation(uint32_t now_us) {
  if (!autopilot_->link.begin('O', ORIENTATION_SIZE)) return false;
  const Attitude& attitude = autopilot_->attitude.attitude();
  Link::Frame::u16(sequence_);
  Link::Frame::hundredths(attitude.yaw_cdeg);
  Link::Frame::hundredths(attitude.pitch_cdeg);
  Link::Frame::hundredths(attitude.roll_cdeg);
  Link::Frame::sixteenths(attitude.yaw_rate_16);
  Link::Frame::sixteenths(attitude.pitch_rate_16);
  Link::Frame::sixteenths(attitude.roll_rate_16);
  autopilot_->link.end();
  sent_[sequence_ % REMEMBERED] = static_cast<uint8_t>(to_units(now_us));
  ++sequence_;
  if (remembered_ < REMEMBERED) ++remembered_;
  return true;
}

bool Forwarder::send_status(uint32_t now_us) {
  if (!autopilot_->link.begin('x', STATUS_SIZE)) return false;
  write_status(*autopilot_, now_us);
  autopilot_->link.end();
  return true;
}

/** Whether any is, and the newest is young enough to be computed from. */
OUT_OF_LINE bool Forwarder::is_remembered(uint8_t now_units) const {
  const uint8_t newest = sent_[static_cast<uint8_t>(sequence_ - 1) % REMEMBERED];
  return remembered_ != 0 && static_cast<uint8_t>(now_units - newest) < MAX_AGE_UNITS;
}

uint32_t Forwarder::orientation_age_us(uint16_t sequence, uint32_t now_us) const {
  const uint8_t now_units = static_cast<uint8_t>(to_units(now_us));
  const uint16_t back = static_cast<uint16_t>(sequence_ - sequence);
  if (back == 0 || back > remembered_ || !is_remembered(now_units)) return NEVER;
  // From the beginning of the unit in which it was sent to the end of this one.
  const uint8_t age = static_cast<uint8_t>(now_units - sent_[sequence % REMEMBERED]);
  return static_cast<uint32_t>(age + 1UL) << 10;
}

void Forwarder::check(uint32_t now_us) {
  if (!is_remembered(static_cast<uint8_t>(to_units(now_us)))) remembered_ = 0;
}

}  // namespace raspilot
