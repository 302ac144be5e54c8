#include "input_channel.h"

#include "range_learner.h"

namespace raspilot {

namespace {

constexpr uint16_t MIN_TICKS = us_to_ticks(885);
constexpr uint16_t MAX_TICKS = us_to_ticks(2115);
constexpr uint16_t NOISE_TICKS = us_to_ticks(300);
constexpr int16_t REST_TICKS = us_to_ticks(2500);
constexpr int16_t STUCK_TICKS = us_to_ticks(3000);
// 100 ms in units of 1024 us, less the slot in which it is noticed.
constexpr uint8_t LOST_UNITS = 96;

int16_t between(uint16_t earlier, uint16_t later) {
  return static_cast<int16_t>(static_cast<uint16_t>(later - earlier));
}
uint8_t without(uint8_t flags, uint8_t gone) { return static_cast<uint8_t>(flags & ~gone); }

}  // namespace

OUT_OF_LINE void InputChannel::begin(Ticks pulse) {
  filter_.reset(pulse);
  pulse_ = pulse;
}

bool InputChannel::on_rise(uint16_t stamp, bool is_late) {
  uint8_t flags = flags_;
  const bool has_rested = (flags & RESTED) || between(fell_at(), stamp) >= REST_TICKS;
  const bool is_proof = has_rested && (flags & REVOCABLE);
  if (is_proof) {
    age_ = 0;
    flags = without(flags, UNPROVEN);
  } else if (flags & REVOCABLE) {
    filter_.reset(before_);
    flags |= CHANGED;
    if (flags & UNPROVEN) flags = without(flags, VALID);
  }
  flags = without(flags, RISEN | MEASURING | UNCERTAIN | RESTED | REVOCABLE);
  if (has_rested) flags |= RISEN | MEASURING;
  if (is_late) flags |= UNCERTAIN;
  flags_ = flags;
  rise_ = stamp;
  return is_proof;
}

InputChannel::Fall InputChannel::on_fall(uint16_t stamp, bool is_late) {
  const uint8_t flags = flags_;
  const uint16_t width = static_cast<uint16_t>(stamp - rise_);
  if (!(flags & MEASURING) || width < NOISE_TICKS) {
    flags_ = without(flags, MEASURING | RISEN);
    note_fall(stamp);
    return NOISE;
  }
  width_ = width;
  if (width < MIN_TICKS || width > MAX_TICKS) {
    flags_ = without(flags, MEASURING | VALID);
    return OUT_OF_RANGE;
  }
  before_ = raw();
  filter_.update(static_cast<Ticks>(width), is_late || (flags & UNCERTAIN));
  flags_ = without(flags, MEASURING) | VALID | CHANGED | REVOCABLE;
  if (!(flags & VALID)) {
    flags_ |= UNPROVEN;
    age_ = 0;
  }
  return GOOD;
}

void InputChannel::begin_again(uint16_t stamp) {
  flags_ = without(flags_, RISEN | MEASURING | RESTED | REVOCABLE);
  note_fall(stamp);
}

void InputChannel::check(bool is_high, uint16_t now_stamp, uint8_t passed_units,
                         const ChannelRange& range) {
  uint8_t flags = flags_;
  if (!is_high) {
    if (between(fell_at(), now_stamp) >= REST_TICKS) flags |= RESTED;
  } else if (between(rise_, now_stamp) >= STUCK_TICKS) {
    flags = without(flags, MEASURING);
  }
  age_ = static_cast<uint8_t>(age_ + passed_units);
  if (age_ >= LOST_UNITS) {
    age_ = LOST_UNITS;
    flags = without(flags, VALID);
  }
  if (flags & CHANGED) pulse_ = calibrated(range, raw());
  flags_ = without(flags, CHANGED);
}

bool InputChannel::take_rise() {
  if ((flags_ & (RISEN | VALID)) != (RISEN | VALID)) return false;
  flags_ = without(flags_, RISEN);
  return true;
}

}  // namespace raspilot
