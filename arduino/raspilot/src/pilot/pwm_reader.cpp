#include "pwm_reader.h"

namespace raspilot {

namespace {

// Stamps have 16 bits of 0.5 us: only half of their range of 32.768 ms is unambiguous.
constexpr uint16_t STALL_UNITS = 15;
constexpr uint8_t MAX_AGED = 127;
constexpr uint16_t MAX_AGE_UNITS = 64000;

}  // namespace

PwmReader::PwmReader(const Calibration& calibration) : calibration_(calibration) {
  for (InputChannel& channel : channels_) channel.begin(us_to_ticks(1500));
  channels_[THROTTLE].begin(us_to_ticks(1000));
  age_.pass(65535);
}

uint16_t PwmReader::passed_units(uint32_t now_us) const {
  return static_cast<uint16_t>(to_units(now_us) - checked_at_);
}

void PwmReader::on_edge(uint16_t stamp_ticks, uint8_t levels, bool is_late, uint32_t now_us) {
  const bool is_lost = is_lost_ || passed_units(now_us) > STALL_UNITS;
  is_lost_ = false;
  uint8_t changed = static_cast<uint8_t>(levels ^ levels_);
  levels_ = levels;
  uint8_t index = 0;
  for (InputChannel& channel : channels_) {
    if (is_lost) {
      channel.begin_again(stamp_ticks);
    } else if (!(changed & 1)) {
      // Another channel's edge.
    } else if (levels & 1) {
      if (channel.on_rise(stamp_ticks, is_late)) learner_.update(index, channel.width());
    } else if (channel.on_fall(stamp_ticks, is_late) != InputChannel::NOISE) {
      age_.start();
    }
    changed = static_cast<uint8_t>(changed >> 1);
    levels = static_cast<uint8_t>(levels >> 1);
    ++index;
  }
}

OUT_OF_LINE void PwmReader::check(uint32_t now_us) {
  const uint16_t passed = passed_units(now_us);
  checked_at_ = to_units(now_us);
  if (passed > STALL_UNITS) is_lost_ = true;
  age_.pass(passed);
  const uint8_t aged = static_cast<uint8_t>(passed < MAX_AGED ? passed : MAX_AGED);
  const uint16_t now_stamp = static_cast<uint16_t>(now_us * 2);
  uint8_t levels = levels_;
  const ChannelRange* range = calibration_->receiver;
  for (InputChannel& channel : channels_) {
    channel.check(levels & 1, now_stamp, aged, *range++);
    levels = static_cast<uint8_t>(levels >> 1);
  }
}

OUT_OF_LINE uint8_t PwmReader::validity() const {
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
  Stopwatch age = age_;
  age.pass(passed_units(now_us));
  const uint16_t units = age.units();
  // 1024 us are 1 + 3/128 ms and a little.
  return units > MAX_AGE_UNITS ? 65535 : static_cast<uint16_t>(units + units / 64 + units / 128);
}

bool PwmReader::take_rise(Channel channel, uint16_t& stamp_ticks) {
  InputChannel& input = channels_[channel];
  stamp_ticks = input.rise();
  return input.take_rise();
}

bool PwmReader::end_range_learning(Calibration& learned) {
  Ticks resting[INPUTS];
  for (uint8_t i = 0; i < INPUTS; ++i) resting[i] = channels_[i].raw();
  return learner_.end(resting, learned.receiver);
}

}  // namespace raspilot
