#include "range_learner.h"

namespace raspilot {

namespace {

constexpr Ticks LOWEST_TICKS = us_to_ticks(885);
constexpr Ticks CENTRE_TICKS = us_to_ticks(1500);
constexpr Ticks HIGHEST_TICKS = us_to_ticks(2115);
constexpr int16_t HALF_TRAVEL_TICKS = us_to_ticks(500);
constexpr int16_t SMALLEST_RANGE_TICKS = us_to_ticks(400);
constexpr int16_t SMALLEST_HALF_TICKS = us_to_ticks(100);

bool rests_anywhere(uint8_t channel) { return channel == THROTTLE || channel >= AUX1; }

}  // namespace

void RangeLearner::begin() {
  for (uint8_t i = 0; i < INPUTS; ++i) {
    lowest_[i] = HIGHEST_TICKS;
    highest_[i] = LOWEST_TICKS;
  }
  is_learning_ = true;
}

void RangeLearner::take(Channel channel, Ticks pulse) {
  if (pulse < lowest_[channel]) lowest_[channel] = pulse;
  if (pulse > highest_[channel]) highest_[channel] = pulse;
}

bool RangeLearner::end(const Ticks* resting, ChannelRange* ranges) {
  const bool was_learning = is_learning_;
  is_learning_ = false;
  if (!was_learning) return false;
  Ticks centres[INPUTS];
  for (uint8_t i = 0; i < INPUTS; ++i) {
    const Ticks lowest = lowest_[i];
    const Ticks highest = highest_[i];
    centres[i] = rests_anywhere(i) ? static_cast<Ticks>((lowest + highest) / 2) : resting[i];
    if (highest - lowest < SMALLEST_RANGE_TICKS || centres[i] - lowest < SMALLEST_HALF_TICKS ||
        highest - centres[i] < SMALLEST_HALF_TICKS) {
      return false;
    }
  }
  for (uint8_t i = 0; i < INPUTS; ++i) {
    ranges[i].lowest_us = ticks_to_us(lowest_[i]);
    ranges[i].centre_us = ticks_to_us(centres[i]);
    ranges[i].highest_us = ticks_to_us(highest_[i]);
  }
  return true;
}

Ticks calibrated(const ChannelRange& range, Ticks pulse) {
  const int16_t centre = static_cast<int16_t>(range.centre_us * 2);
  const int16_t offset = static_cast<int16_t>(pulse - centre);
  const int16_t half = static_cast<int16_t>(
      offset < 0 ? centre - range.lowest_us * 2 : range.highest_us * 2 - centre);
  if (half <= 0) return pulse;
  Ticks scaled = offset;
  if (half != HALF_TRAVEL_TICKS) {
    const int32_t product = static_cast<int32_t>(offset) * HALF_TRAVEL_TICKS;
    const int16_t rounding = static_cast<int16_t>(offset < 0 ? -half / 2 : half / 2);
    const int32_t quotient = (product + rounding) / half;
    if (quotient < LOWEST_TICKS - CENTRE_TICKS) return LOWEST_TICKS;
    if (quotient > HIGHEST_TICKS - CENTRE_TICKS) return HIGHEST_TICKS;
    scaled = static_cast<Ticks>(quotient);
  }
  scaled = static_cast<Ticks>(scaled + CENTRE_TICKS);
  return scaled < LOWEST_TICKS ? LOWEST_TICKS : scaled > HIGHEST_TICKS ? HIGHEST_TICKS : scaled;
}

}  // namespace raspilot
