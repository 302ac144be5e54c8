#include "cascade.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr int32_t HALF_CIRCLE_CDEG = 18000;
constexpr int32_t CIRCLE_CDEG = 36000;

// Rates come in 2^-4, so the Rate PID answers in 2^-14; a unit is 2.5 ticks.
constexpr int32_t RATE_LIMIT = static_cast<int32_t>(RATE_OUTPUT_LIMIT) << 14;
// Angles come in 2^-7, so the Stabilize PID answers in 2^-17: 2^13 make a sixteenth.
constexpr uint8_t STABILIZE_BITS = 17;
constexpr uint8_t TO_16THS = 13;
// 128 / 100 in Q14.
constexpr int16_t CDEG_TO_128THS = 20972;

int16_t to_128ths(int16_t cdeg) { return times_q14(cdeg, CDEG_TO_128THS); }

}  // namespace

RateLoop::RateLoop() : pid_(RATE_LIMIT) {}

Ticks RateLoop::hold(int16_t wanted_16, int16_t rate_16) {
  const int16_t error = difference_of(wanted_16, rate_16);
  return static_cast<Ticks>(rounded(pid_.update(error, rate_16) * 5, 15));
}

Cascade::Cascade(int16_t rate_limit_deg_s)
    : stabilize_(static_cast<int32_t>(rate_limit_deg_s) << STABILIZE_BITS) {}

Ticks Cascade::hold_angle(int16_t wanted_cdeg, int16_t angle_cdeg, int16_t rate_16) {
  // The shorter way round.
  int32_t error_cdeg = static_cast<int32_t>(wanted_cdeg) - angle_cdeg;
  if (error_cdeg > HALF_CIRCLE_CDEG) error_cdeg -= CIRCLE_CDEG;
  if (error_cdeg < -HALF_CIRCLE_CDEG) error_cdeg += CIRCLE_CDEG;
  const int16_t error = to_128ths(static_cast<int16_t>(error_cdeg));
  const int32_t wanted = stabilize_.update(error, to_128ths(angle_cdeg));
  return rate_.hold(static_cast<int16_t>(rounded(wanted, TO_16THS)), rate_16);
}

}  // namespace raspilot
