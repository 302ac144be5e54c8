// The filter's calibration: the gyro's bias of a still second, and level.
#include "attitude_filter.h"
#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr int32_t ONE_Q30 = 1L << 30;
// A sixteenth of a count in sixteenths of a deg/s, Q15.
constexpr int16_t COUNT_TO_DEG_S = 999;
// EEPROM lasts 100,000 writes: a new bias is stored when it differs by half a deg/s.
constexpr int16_t BIAS_CHANGE_16 = 8;

}  // namespace

/** The still second that was searched for: its bias also flies after a reset with lost memory. */
void AttitudeFilter::on_still() {
  use_own_bias();
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int16_t change_16 = difference_of(mean_16(axis), calibration_->gyro_bias_16[axis]);
    if (clamped16(change_16, BIAS_CHANGE_16) != change_16) has_new_bias_ = true;
  }
  if (has_new_bias_) keep_bias();
}

int16_t AttitudeFilter::mean_16(uint8_t axis) const {
  return times_q15(stillness_.mean_q4()[axis], COUNT_TO_DEG_S);
}

OUT_OF_LINE void AttitudeFilter::keep_bias() {
  for (uint8_t axis = 0; axis < 3; ++axis) calibration_->gyro_bias_16[axis] = mean_16(axis);
}

bool AttitudeFilter::take_new_bias() {
  const bool has_new_bias = has_new_bias_;
  has_new_bias_ = false;
  return has_new_bias;
}

bool AttitudeFilter::is_calibrating() const {
  return !state_.has_bias || !(state_.has_ended_search || has_searched_long());
}

Reason AttitudeFilter::refusal() const {
  if (!is_valid()) return Reason::IMU_INVALID;
  return is_still() ? Reason::NONE : Reason::NOT_STILL;
}

Reason AttitudeFilter::calibrate_gyro() {
  if (refusal() != Reason::NONE) return refusal();
  use_own_bias();
  keep_bias();
  return Reason::NONE;
}

Reason AttitudeFilter::calibrate_level() {
  if (refusal() != Reason::NONE) return refusal();
  // The sensor's own angles: as if nothing had been level before.
  level_.tilt(down_);
  find_angles();
  const bool is_in_range =
      clamped16(attitude_.roll_cdeg, Level::MAX_CDEG) == attitude_.roll_cdeg &&
      clamped16(attitude_.pitch_cdeg, Level::MAX_CDEG) == attitude_.pitch_cdeg;
  if (is_in_range) {
    calibration_->level_roll_cdeg = attitude_.roll_cdeg;
    calibration_->level_pitch_cdeg = attitude_.pitch_cdeg;
    level_.set(attitude_.roll_cdeg, attitude_.pitch_cdeg);
    state_.gravity_q30[0] = state_.gravity_q30[1] = 0;
    state_.gravity_q30[2] = ONE_Q30;
  }
  find_down();
  find_angles();
  return is_in_range ? Reason::NONE : Reason::OUT_OF_RANGE;
}

}  // namespace raspilot
