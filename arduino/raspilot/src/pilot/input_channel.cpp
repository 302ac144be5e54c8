#include "input_channel.h"

#include "range_learner.h"

namespace raspilot {

namespace {

constexpr uint16_t NARROWEST_TICKS = us_to_ticks(885);
constexpr uint16_t WIDEST_TICKS = us_to_ticks(2115);
constexpr uint16_t NOISE_TICKS = us_to_ticks(300);
constexpr int16_t REST_TICKS = us_to_ticks(2500);
constexpr int16_t STUCK_TICKS = us_to_ticks(3000);
// 100 ms in units of 1024 us, less the slot in which it is noticed.
constexpr uint16_t LOST_UNITS = 96;

int16_t between(uint16_t earlier, uint16_t later) {
  return static_cast<int16_t>(static_cast<uint16_t>(later - earlier));
}

}  // namespace

InputChannel::InputChannel(Ticks pulse)
    : is_new(false),
      has_risen(false),
      is_valid_(false),
      is_measuring_(false),
      is_uncertain_(false),
      has_rested_(false),
      is_revocable_(false),
      is_unproven_(false),
      pulse_(pulse),
      before_(pulse) {
  filter_.reset(pulse);
}

bool InputChannel::on_rise(uint16_t stamp, bool is_late, uint16_t now_units,
                           const ChannelRange& range) {
  const bool was_pulse = is_revocable_;
  const bool has_rested = has_rested_ || between(fell_at(), stamp) >= REST_TICKS;
  if (!has_rested && was_pulse) {
    filter_.reset(before_);
    show(before_, range);
    if (is_unproven_) is_valid_ = false;
    is_new = false;
  }
  const bool is_proof = has_rested && was_pulse;
  if (is_proof) {
    proven_at_ = now_units;
    is_unproven_ = false;
  }
  is_measuring_ = has_rested;
  has_risen = has_rested;
  is_revocable_ = false;
  has_rested_ = false;
  is_uncertain_ = is_late;
  rise_ = stamp;
  return is_proof;
}

InputChannel::Fall InputChannel::on_fall(uint16_t stamp, bool is_late, uint16_t now_units,
                                         const ChannelRange& range) {
  const uint16_t width = static_cast<uint16_t>(stamp - rise_);
  const bool is_pulse = is_measuring_ && width >= NOISE_TICKS;
  is_measuring_ = false;
  if (!is_pulse) {
    has_risen = false;
    note_fall(stamp);
    return NOISE;
  }
  width_ = width;
  if (width < NARROWEST_TICKS || width > WIDEST_TICKS) {
    is_valid_ = false;
    return OUT_OF_RANGE;
  }
  before_ = raw();
  filter_.take(static_cast<Ticks>(width), is_late || is_uncertain_);
  show(raw(), range);
  if (!is_valid_) {
    is_valid_ = is_unproven_ = true;
    proven_at_ = now_units;
  }
  is_revocable_ = is_new = true;
  return GOOD;
}

void InputChannel::show(Ticks raw, const ChannelRange& range) { pulse_ = calibrated(range, raw); }

void InputChannel::begin_again(uint16_t stamp) {
  is_measuring_ = is_revocable_ = has_rested_ = has_risen = false;
  note_fall(stamp);
}

void InputChannel::check(bool is_high, uint16_t now_stamp, uint16_t now_units) {
  if (!is_high) {
    if (between(fell_at(), now_stamp) >= REST_TICKS) has_rested_ = true;
  } else if (between(rise_, now_stamp) >= STUCK_TICKS) {
    is_measuring_ = false;
  }
  if (static_cast<uint16_t>(now_units - proven_at_) >= LOST_UNITS) is_valid_ = false;
}

}  // namespace raspilot
