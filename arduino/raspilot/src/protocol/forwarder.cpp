#include "forwarder.h"

#include "../core/autopilot.h"
#include "../store/wire_bytes.h"
#include "status.h"

namespace raspilot {

namespace {

// Of 10 bits a byte 70 % at most; the status takes 26 bytes of it five times a second.
constexpr uint32_t LOAD_BYTES_S = RASPILOT_BAUD / 10 * 7 / 10;
constexpr uint32_t STATUS_BYTES_S = 26 * 5;
constexpr uint32_t STREAMED_BYTES = 19 + 32 + 14;
constexpr uint32_t LEAST_PERIOD_US = STREAMED_BYTES * 1000000UL / (LOAD_BYTES_S - STATUS_BYTES_S);
constexpr uint32_t PERIOD_US = LEAST_PERIOD_US > 20000 ? LEAST_PERIOD_US : 20000;
constexpr uint32_t STATUS_PERIOD_US = 200000;
constexpr uint32_t THESIS_PERIOD_US = 50000;
constexpr uint32_t US_PER_MS = 1000;
constexpr uint32_t OUTPUT_AGE_US = 100000;
constexpr uint8_t STEP_BITS = 6;
constexpr uint8_t ORIENTATION_SIZE = 26;
constexpr uint8_t ATTITUDE_SIZE = 12;

void write_angles(const Attitude& attitude, WireWriter& writer) {
  writer.hundredths(attitude.yaw_cdeg);
  writer.hundredths(attitude.pitch_cdeg);
  writer.hundredths(attitude.roll_cdeg);
}

}  // namespace

constexpr uint32_t Forwarder::NEVER;

void Forwarder::start(uint32_t now_us) {
  if (is_started_) return;
  is_started_ = true;
  for (uint8_t stream = 0; stream < STREAMS; ++stream) due_us_[stream] = now_us;
}

bool Forwarder::send_next(uint32_t now_us) {
  if (!is_started_) return false;
  for (uint8_t tried = 0; tried < STREAMS; ++tried) {
    const uint8_t stream = next_;
    if (is_due(stream, now_us)) {
      // What does not fit stays due and is sent with newer values; nothing overtakes it.
      if (!send(stream, now_us)) return false;
      const uint32_t period = period_us(stream);
      due_us_[stream] += period;
      if (static_cast<int32_t>(now_us - due_us_[stream]) >= 0) due_us_[stream] = now_us + period;
      next_ = static_cast<uint8_t>((stream + 1) % STREAMS);
      return true;
    }
    next_ = static_cast<uint8_t>((stream + 1) % STREAMS);
  }
  return false;
}

uint32_t Forwarder::period_us(uint8_t stream) const {
  if (stream == STATUS_STREAM) return STATUS_PERIOD_US;
  const bool is_thesis = autopilot_.link.is_thesis();
  const uint32_t usual_us = is_thesis ? THESIS_PERIOD_US : PERIOD_US;
  if (period_ms_ == 0) return usual_us;
  const uint32_t asked_us = period_ms_ * US_PER_MS;
  const bool is_consumed = stream != OUTPUTS_STREAM && autopilot_.authority.mode() == Mode::OUTPUT;
  if (is_consumed && asked_us > usual_us) return usual_us;
  const uint32_t least_us = is_thesis ? THESIS_PERIOD_US : LEAST_PERIOD_US;
  return asked_us < least_us ? least_us : asked_us;
}

bool Forwarder::is_due(uint8_t stream, uint32_t now_us) {
  const uint32_t due_us = due_us_[stream];
  if (static_cast<int32_t>(now_us - due_us) >= 0) return true;
  // A shorter period holds at once, not after the long one that was waited for.
  const uint32_t soonest_us = now_us + period_us(stream);
  if (static_cast<int32_t>(due_us - soonest_us) > 0) due_us_[stream] = soonest_us;
  return false;
}

/** Sends it, or finds that it has nothing to say; false when it does not fit. */
bool Forwarder::send(uint8_t stream, uint32_t now_us) {
  const bool is_thesis = autopilot_.link.is_thesis();
  switch (stream) {
    case INPUTS_STREAM: return is_thesis || send_inputs();
    case ORIENTATION_STREAM:
      // An attitude that is none is not said: who listens sees it grow old.
      if (!autopilot_.attitude.is_valid()) return true;
      return is_thesis ? send_attitude() : send_orientation(now_us);
    case OUTPUTS_STREAM: return send_outputs();
    default: return is_thesis || send_status(now_us);
  }
}

bool Forwarder::send_inputs() {
  const PwmReader& receiver = autopilot_.receiver;
  const uint8_t validity = receiver.validity();
  uint8_t payload[2 * INPUTS + 1];
  WireWriter writer(payload);
  for (uint8_t channel = 0; channel < INPUTS; ++channel) {
    const Channel each = static_cast<Channel>(channel);
    // A pulse out of range is told as it is, so that it can be understood.
    writer.u16((validity >> channel & 1) != 0 ? ticks_to_us(receiver.pulse(each))
                                              : receiver.measured_us(each));
  }
  writer.u8(validity);
  return autopilot_.link.send('i', payload, sizeof payload);
}

bool Forwarder::send_outputs() {
  const Outputs& outputs = autopilot_.controller.outputs();
  uint8_t payload[2 * OUTPUTS];
  WireWriter writer(payload);
  for (uint8_t output = 0; output < OUTPUTS; ++output) {
    writer.u16(ticks_to_us(outputs.ticks[output]));
  }
  return autopilot_.link.send('r', payload, sizeof payload);
}

bool Forwarder::send_orientation(uint32_t now_us) {
  if (!autopilot_.link.has_room(ORIENTATION_SIZE)) return false;
  const Attitude& attitude = autopilot_.attitude.attitude();
  uint8_t payload[ORIENTATION_SIZE];
  WireWriter writer(payload);
  writer.u16(sequence_);
  write_angles(attitude, writer);
  writer.sixteenths(attitude.yaw_rate_16);
  writer.sixteenths(attitude.pitch_rate_16);
  writer.sixteenths(attitude.roll_rate_16);
  if (!autopilot_.link.send('O', payload, sizeof payload)) return false;
  remember(now_us);
  return true;
}

bool Forwarder::send_attitude() {
  uint8_t payload[ATTITUDE_SIZE];
  WireWriter writer(payload);
  write_angles(autopilot_.attitude.attitude(), writer);
  return autopilot_.link.send('o', payload, sizeof payload);
}

bool Forwarder::send_status(uint32_t now_us) {
  if (!autopilot_.link.has_room(STATUS_SIZE)) return false;
  uint8_t payload[STATUS_SIZE];
  write_status(autopilot_, now_us, payload);
  return autopilot_.link.send('x', payload, sizeof payload);
}

void Forwarder::remember(uint32_t now_us) {
  sent_[sequence_ % REMEMBERED] = static_cast<uint16_t>(now_us >> STEP_BITS);
  ++sequence_;
  if (remembered_ < REMEMBERED) ++remembered_;
  remembered_us_ = now_us;
}

uint32_t Forwarder::orientation_age_us(uint16_t sequence, uint32_t now_us) const {
  const uint16_t back = static_cast<uint16_t>(sequence_ - sequence);
  if (back == 0 || back > remembered_ || now_us - remembered_us_ > OUTPUT_AGE_US) return NEVER;
  const uint16_t now = static_cast<uint16_t>(now_us >> STEP_BITS);
  const uint16_t age = static_cast<uint16_t>(now - sent_[sequence % REMEMBERED]);
  return static_cast<uint32_t>(age) << STEP_BITS;
}

void Forwarder::check(uint32_t now_us) {
  if (remembered_ != 0 && now_us - remembered_us_ > OUTPUT_AGE_US) remembered_ = 0;
}

}  // namespace raspilot
