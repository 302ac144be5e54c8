#include "range_learner.h"

#include <string.h>

namespace raspilot {

namespace {

constexpr Ticks MIN_TICKS = us_to_ticks(885);
constexpr Ticks CENTRE_TICKS = us_to_ticks(1500);
constexpr Ticks MAX_TICKS = us_to_ticks(2115);
constexpr int16_t HALF_TRAVEL_TICKS = us_to_ticks(500);
constexpr uint16_t MIN_HALF_US = 200;

uint16_t to_us(uint16_t ticks) { return static_cast<uint16_t>((ticks + 1) >> 1); }
bool rests_anywhere(uint8_t channel) { return channel == THROTTLE || channel >= AUX1; }

}  // namespace

void RangeLearner::begin() {
  for (Ends& ends : ends_) {
    ends.lowest = MAX_TICKS;
    ends.highest = MIN_TICKS;
  }
  is_learning_ = true;
}

void RangeLearner::update(uint8_t channel, uint16_t width_ticks) {
  if (!is_learning_) return;
  Ends& ends = ends_[channel];
  if (width_ticks < ends.lowest) ends.lowest = width_ticks;
  if (width_ticks > ends.highest) ends.highest = width_ticks;
}

bool RangeLearner::end(const Ticks* resting, ChannelRange* ranges) {
  if (!is_learning_) return false;
  is_learning_ = false;
  ChannelRange learned[INPUTS];
  for (uint8_t i = 0; i < INPUTS; ++i) {
    ChannelRange& range = learned[i];
    range.lowest_us = to_us(ends_[i].lowest);
    range.highest_us = to_us(ends_[i].highest);
    range.centre_us = rests_anywhere(i)
                          ? static_cast<uint16_t>((range.lowest_us + range.highest_us) / 2)
                          : to_us(static_cast<uint16_t>(resting[i]));
    if (range.centre_us < range.lowest_us + MIN_HALF_US ||
        range.highest_us < range.centre_us + MIN_HALF_US) {
      return false;
    }
  }
  memcpy(ranges, learned, sizeof learned);
  return true;
}

Ticks calibrated(const ChannelRange& range, Ticks pulse) {
  const uint16_t centre_us = range.centre_us;
  int16_t offset = static_cast<int16_t>(pulse - centre_us * 2);
  const uint16_t half_us = static_cast<uint16_t>(offset < 0 ? centre_us - range.lowest_us
                                                            : range.highest_us - centre_us);
  const int16_t half = static_cast<int16_t>(half_us * 2);
  if (half != HALF_TRAVEL_TICKS) {
    // A half of 100 us makes at most 12300 ticks of it.
    offset = static_cast<int16_t>(static_cast<int32_t>(offset) * HALF_TRAVEL_TICKS / half);
  }
  const Ticks scaled = static_cast<Ticks>(CENTRE_TICKS + offset);
  return scaled < MIN_TICKS ? MIN_TICKS : scaled > MAX_TICKS ? MAX_TICKS : scaled;
}

}  // namespace raspilot
