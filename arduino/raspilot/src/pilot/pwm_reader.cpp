#include "pwm_reader.h"

namespace raspilot {

namespace {

// Stamps have 16 bits of 0.5 us: only half of their 32.768 ms is told apart from the other.
constexpr uint32_t STALL_US = 16000;
constexpr uint32_t OLDEST_AGE_US = 65535000;
constexpr Ticks CENTRE = us_to_ticks(1500);
constexpr Ticks LOW = us_to_ticks(1000);

uint16_t to_units(uint32_t now_us) { return static_cast<uint16_t>(now_us >> 10); }

}  // namespace

PwmReader::PwmReader(const Calibration& calibration)
    : calibration_(calibration),
      channels_{InputChannel(CENTRE), InputChannel(CENTRE), InputChannel(LOW),
                InputChannel(CENTRE), InputChannel(CENTRE), InputChannel(CENTRE)} {}

void PwmReader::on_edge(uint16_t stamp_ticks, uint8_t levels, bool is_late, uint32_t now_us) {
  uint8_t changed = static_cast<uint8_t>(levels ^ levels_);
  levels_ = levels;
  if (is_lost_ || now_us - checked_us_ > STALL_US) {
    is_lost_ = false;
    for (InputChannel& channel : channels_) channel.begin_again(stamp_ticks);
    return;
  }
  for (uint8_t i = 0; i < INPUTS; ++i) {
    if (changed & 1) on_change(i, stamp_ticks, levels & 1, is_late, now_us);
    changed = static_cast<uint8_t>(changed >> 1);
    levels = static_cast<uint8_t>(levels >> 1);
  }
}

void PwmReader::on_change(uint8_t index, uint16_t stamp, bool is_high, bool is_late,
                          uint32_t now_us) {
  InputChannel& channel = channels_[index];
  const ChannelRange& range = calibration_.receiver[index];
  const uint16_t now_units = to_units(now_us);
  if (is_high) {
    const bool is_proof = channel.on_rise(stamp, is_late, now_units, range);
    if (is_proof && learner_.is_learning()) {
      learner_.take(static_cast<Channel>(index), static_cast<Ticks>(channel.width()));
    }
  } else if (channel.on_fall(stamp, is_late, now_units, range) != InputChannel::NOISE) {
    newest_us_ = now_us;
    has_age_ = true;
  }
}

void PwmReader::check(uint32_t now_us) {
  if (now_us - checked_us_ > STALL_US) is_lost_ = true;
  checked_us_ = now_us;
  if (now_us - newest_us_ > OLDEST_AGE_US) has_age_ = false;
  const uint16_t now_stamp = static_cast<uint16_t>(now_us * 2);
  const uint16_t now_units = to_units(now_us);
  uint8_t levels = levels_;
  for (InputChannel& channel : channels_) {
    channel.check(levels & 1, now_stamp, now_units);
    levels = static_cast<uint8_t>(levels >> 1);
  }
}

uint8_t PwmReader::validity() const {
  uint8_t valid = 0;
  for (uint8_t i = INPUTS; i-- > 0;) {
    valid = static_cast<uint8_t>(valid << 1 | channels_[i].is_valid());
  }
  return valid;
}

uint16_t PwmReader::measured_us(Channel channel) const {
  const uint16_t width = channels_[channel].width();
  return static_cast<uint16_t>(width / 2 + (width & 1));
}

uint16_t PwmReader::age_ms(uint32_t now_us) const {
  const uint32_t age_us = now_us - newest_us_;
  return !has_age_ || age_us > OLDEST_AGE_US ? 65535 : static_cast<uint16_t>(age_us / 1000);
}

bool PwmReader::take_frame() {
  for (const InputChannel& channel : channels_) {
    if (!channel.is_new) return false;
  }
  for (InputChannel& channel : channels_) channel.is_new = false;
  return true;
}

bool PwmReader::take_rise(Channel channel, uint16_t& stamp_ticks) {
  InputChannel& input = channels_[channel];
  if (!input.has_risen || !input.is_valid()) return false;
  input.has_risen = false;
  stamp_ticks = input.rise();
  return true;
}

bool PwmReader::end_range_learning(Calibration& learned) {
  Ticks resting[INPUTS];
  for (uint8_t i = 0; i < INPUTS; ++i) resting[i] = channels_[i].raw();
  return learner_.end(resting, learned.receiver);
}

}  // namespace raspilot
