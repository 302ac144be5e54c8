#include "attitude_filter.h"

#include "angles.h"
#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr uint32_t SLOT_US = 2000;
constexpr uint32_t HALF_SLOT_US = SLOT_US / 2;
constexpr uint32_t STALE_US = 50000;
constexpr uint32_t LOST_US = 500000;
constexpr uint32_t AGE_LIMIT_US = 65535000;
constexpr uint16_t AGE_LIMIT_MS = 65535;
constexpr uint8_t FROZEN_COPIES = 24;  // with the one they copy 25 samples, 50 ms
constexpr uint8_t GOOD_ENOUGH = 10;
constexpr uint8_t MOST_PENDING_SLOTS = 25;
constexpr uint8_t STEPS_A_SLOT = 2;
constexpr uint16_t SEARCH_SLOTS = 5000;

// One gyro count (1 / 32.8 deg/s) for one slot is 1.0642e-6 rad: 4570.9 in Q32.
constexpr int16_t TURN_PER_COUNT = 4571;
// A sixteenth of a degree per second likewise.
constexpr int32_t TURN_PER_16TH = 9370;
// Angles of a slot leave as Q19; one of them a slot is 0.87427 sixteenths of a degree per second.
constexpr uint8_t ANGLE_SHIFT = 13;
constexpr int32_t ANGLE_REST = (1L << ANGLE_SHIFT) - 1;
constexpr int16_t RATE_Q15 = 28648;

constexpr int32_t ONE_Q30 = 1L << 30;
constexpr int32_t ONE_Q28 = 1L << 28;
constexpr int16_t LEAST_COSINE_SQUARED_Q14 = 820;  // pitch of 77 degrees: yaw means little above
constexpr int32_t YAW_PER_Q17 = 5215;              // 2^32 / (2 pi) / 2^17
constexpr int16_t HALF_CIRCLE_CDEG = 18000;

// Four samples are collected for one look at the accelerometer, each at most 1.39 g an axis.
constexpr uint8_t GROUP = 4;
constexpr int16_t GREATEST_ACCEL = 5700;
constexpr int32_t LEAST_SQUARE = static_cast<int32_t>(0.81 * ONE_Q28);
constexpr int32_t GREATEST_SQUARE = static_cast<int32_t>(1.21 * ONE_Q28);
constexpr int32_t LEAST_SQUARE_FINDING = static_cast<int32_t>(0.49 * ONE_Q28);
constexpr int32_t GREATEST_SQUARE_FINDING = static_cast<int32_t>(1.69 * ONE_Q28);

// The accelerometer draws gravity by 2^-n of the difference every 8 ms.
constexpr uint8_t FINDING_SHIFT = 2;
constexpr uint8_t SETTLING_SHIFT = 7;  // 1.0 s
constexpr uint8_t FLYING_SHIFT = 11;   // 16.4 s
constexpr uint8_t FINDING_GROUPS = 16;
constexpr uint8_t SETTLED_GROUPS = 250;

// Drift: a quarter of the square of the draw's rate a second, so that it just does not swing; at most
// 1 deg/s from the calibrated bias.
constexpr uint8_t DRIFT_SHIFT = 2;
constexpr uint8_t DRIFT_FRACTION = 4;
constexpr int32_t GREATEST_DRIFT = 16 * TURN_PER_16TH << DRIFT_FRACTION;

// A turn of more than 2.5 deg/s about the vertical, low-passed with 0.5 s, tilts what the
// accelerometer takes for down.
constexpr uint8_t TURN_SHIFT = 6;
constexpr int32_t TURN_LIMIT = 46;

int16_t negative(int16_t value) { return difference_of(0, value); }

int32_t bias_of_16ths(int16_t bias_16) { return bias_16 * TURN_PER_16TH; }

}  // namespace

AttitudeFilter::AttitudeFilter(Calibration& calibration)
    : calibration_(calibration),
      attitude_(),
      gravity_(),
      base_bias_(),
      drift_(),
      remainder_(),
      measured_(),
      yaw_(0),
      search_slots_(SEARCH_SLOTS) {
  gravity_[2] = ONE_Q30;
}

void AttitudeFilter::begin() {
  has_begun_ = true;
  level_.set(calibration_.level_roll_cdeg, calibration_.level_pitch_cdeg);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    base_bias_[axis] = bias_of_16ths(calibration_.gyro_bias_16[axis]);
  }
}

void AttitudeFilter::on_sample(const ImuSample& sample, uint32_t now_us) {
  if (is_garbage(sample) || is_copy(sample)) {
    on_missing(now_us);
    return;
  }
  if (!has_begun_) begin();
  pass(now_us);
  int16_t gyro[3] = {sample.gyro[0], negative(sample.gyro[1]), negative(sample.gyro[2])};
  int16_t down[3] = {negative(sample.accel[0]), sample.accel[1], sample.accel[2]};
  follow_stillness(gyro);
  collect(down);
  for (uint8_t step = 0; step < STEPS_A_SLOT && pending_slots_ != 0; ++step) {
    --pending_slots_;
    integrate(gyro);
  }
  normalize();
  if (phase_ == 0) correct();
  find_angles();
  if (good_samples_ < GOOD_ENOUGH) {
    ++good_samples_;
  } else {
    is_fresh_ = true;
  }
}

void AttitudeFilter::on_missing(uint32_t now_us) {
  const uint32_t age_us = now_us - newest_us_;
  if (!has_sample_ || age_us < STALE_US) return;
  is_fresh_ = false;
  good_samples_ = 0;
  stillness_.forget();
  if (age_us >= LOST_US) lose();
  if (age_us >= AGE_LIMIT_US) has_sample_ = false;
}

/** What turned meanwhile is not known any more: gravity is to be found anew. */
void AttitudeFilter::lose() {
  has_gravity_ = false;
  found_groups_ = 0;
  pending_slots_ = 0;
}

bool AttitudeFilter::is_copy(const ImuSample& sample) {
  const uint16_t print = fingerprint(sample);
  const bool is_same = has_sample_ && print == print_;
  print_ = print;
  if (!is_same) {
    copies_ = 0;
  } else if (copies_ < FROZEN_COPIES) {
    ++copies_;
  }
  if (copies_ < FROZEN_COPIES) return false;
  // They came in time, and yet the attitude is as old as the first of them.
  is_fresh_ = false;
  good_samples_ = 0;
  return true;
}

/** Counts the slots since the last sample; more than one sample was missed is made up for later. */
void AttitudeFilter::pass(uint32_t now_us) {
  uint32_t passed_us = now_us - newest_us_;
  newest_us_ = now_us;
  if (!has_sample_) {
    has_sample_ = true;
    pending_slots_ = 1;
    return;
  }
  if (passed_us >= LOST_US) lose();
  // Slots are never far off their 2000 us: a division would take longer.
  while (passed_us > HALF_SLOT_US && pending_slots_ < MOST_PENDING_SLOTS) {
    ++pending_slots_;
    if (passed_us <= SLOT_US) break;
    passed_us -= SLOT_US;
  }
}

void AttitudeFilter::follow_stillness(const int16_t* gyro) {
  if (search_slots_ != 0) --search_slots_;
  if (stillness_.on_sample(gyro) && is_looking_) {
    take_bias(stillness_.mean_q4());
    is_bias_from_eeprom_ = false;
    is_looking_ = false;
  }
}

void AttitudeFilter::take_bias(const int16_t* bias_q4) {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    base_bias_[axis] = rounded(product(bias_q4[axis], TURN_PER_COUNT), 4);
    drift_[axis] = 0;
  }
}

int32_t AttitudeFilter::bias_of(uint8_t axis) const {
  return base_bias_[axis] + (drift_[axis] >> DRIFT_FRACTION);
}

void AttitudeFilter::integrate(const int16_t* gyro) {
  int16_t angle[3];
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int32_t turn = product(gyro[axis], TURN_PER_COUNT) - bias_of(axis) + remainder_[axis];
    angle[axis] = static_cast<int16_t>(turn >> ANGLE_SHIFT);
    remainder_[axis] = static_cast<int16_t>(turn & ANGLE_REST);
  }
  level_.straighten(angle);
  attitude_.roll_rate_16 = times_q15(angle[0], RATE_Q15);
  attitude_.pitch_rate_16 = times_q15(angle[1], RATE_Q15);
  attitude_.yaw_rate_16 = times_q15(angle[2], RATE_Q15);
  turn_gravity(angle);
  integrate_yaw(angle);
}

void AttitudeFilter::find_down(int16_t* down) const {
  for (uint8_t axis = 0; axis < 3; ++axis) down[axis] = upper_half(gravity_[axis]);
}

/** What is fixed to the earth turns against the aircraft: the vector product with the rotation. */
void AttitudeFilter::turn_gravity(const int16_t* angle) {
  int16_t down[3];
  find_down(down);
  gravity_[0] += cross(down[1], angle[2], down[2], angle[1]) >> 3;
  gravity_[1] += cross(down[2], angle[0], down[0], angle[2]) >> 3;
  gravity_[2] += cross(down[0], angle[1], down[1], angle[0]) >> 3;
  if (phase_ == 0) {
    turn_rate_ -= rounded(turn_rate_, TURN_SHIFT);
    for (uint8_t axis = 0; axis < 3; ++axis) turn_rate_ += times_q14(down[axis], angle[axis]);
  }
}

/** One step of Newton's towards the length 1. */
void AttitudeFilter::normalize() {
  int16_t down[3];
  find_down(down);
  const int16_t half_lack_q16 = to_int16((ONE_Q28 - sum_of_squares(down)) >> 13);
  for (uint8_t axis = 0; axis < 3; ++axis) gravity_[axis] += product(down[axis], half_lack_q16);
}

/** Heading turns by (q sin roll + r cos roll) / cos pitch; the division's rest is kept. */
void AttitudeFilter::integrate_yaw(const int16_t* angle) {
  const int16_t y = upper_half(gravity_[1]);
  const int16_t z = upper_half(gravity_[2]);
  yaw_change_ += (product(y, angle[1]) >> 2) + (product(z, angle[2]) >> 2);
  if ((phase_ & 1) == 0) return;
  int16_t cosine_squared = to_int16((product(y, y) >> 14) + (product(z, z) >> 14));
  if (cosine_squared < LEAST_COSINE_SQUARED_Q14) cosine_squared = LEAST_COSINE_SQUARED_Q14;
  const int32_t change_q17 = yaw_change_ / cosine_squared;
  yaw_change_ -= change_q17 * cosine_squared;
  yaw_ += static_cast<uint32_t>(change_q17) * static_cast<uint32_t>(YAW_PER_Q17);
}

void AttitudeFilter::collect(const int16_t* down) {
  if (phase_ == 0) measured_[0] = measured_[1] = measured_[2] = 0;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    measured_[axis] = static_cast<int16_t>(measured_[axis] + clamped16(down[axis], GREATEST_ACCEL));
  }
  phase_ = static_cast<uint8_t>((phase_ + 1) % GROUP);
}

void AttitudeFilter::correct() {
  level_.straighten(measured_);
  const bool is_finding = found_groups_ < FINDING_GROUPS;
  const int32_t square = sum_of_squares(measured_);
  const int32_t least = is_finding ? LEAST_SQUARE_FINDING : LEAST_SQUARE;
  const int32_t greatest = is_finding ? GREATEST_SQUARE_FINDING : GREATEST_SQUARE;
  const bool is_one_g = square >= least && square <= greatest;
  if (is_finding) {
    if (!is_one_g) return;
    if (found_groups_ == 0) gravity_[0] = gravity_[1] = gravity_[2] = 0;
    draw(FINDING_SHIFT);
    has_gravity_ = ++found_groups_ == FINDING_GROUPS;
    return;
  }
  const bool is_settling = found_groups_ < SETTLED_GROUPS;
  if (is_settling) ++found_groups_;
  if (!is_one_g || is_turning()) return;
  draw(is_settling ? SETTLING_SHIFT : FLYING_SHIFT);
  if (!is_settling) learn_drift();
}

/** Moves gravity by 2^-shift of the way to what was measured. */
void AttitudeFilter::draw(uint8_t shift) {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int32_t measured = (measured_[axis] * static_cast<int32_t>(65536)) >> shift;
    gravity_[axis] += measured - (gravity_[axis] >> shift);
  }
}

/** The rotation that leads to what was measured, summed up, is what the gyro reads too much. */
void AttitudeFilter::learn_drift() {
  const int16_t* seen = measured_;
  int16_t down[3];
  find_down(down);
  int16_t error[3] = {upper_half(cross(seen[1], down[2], seen[2], down[1])),
                      upper_half(cross(seen[2], down[0], seen[0], down[2])),
                      upper_half(cross(seen[0], down[1], seen[1], down[0]))};
  level_.tilt(error);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    drift_[axis] = clamped(drift_[axis] - rounded(error[axis], DRIFT_SHIFT), GREATEST_DRIFT);
  }
}

bool AttitudeFilter::is_turning() const {
  const int32_t rate = rounded(turn_rate_, TURN_SHIFT);
  return clamped(rate, TURN_LIMIT) != rate;
}

void AttitudeFilter::find_angles() {
  const int16_t y = upper_half(gravity_[1]);
  const int16_t z = upper_half(gravity_[2]);
  attitude_.roll_cdeg = arc_tangent_cdeg(y, z);
  attitude_.pitch_cdeg = arc_tangent_cdeg(negative(upper_half(gravity_[0])), length(y, z));
  const int16_t yaw = static_cast<int16_t>(static_cast<uint16_t>(yaw_ >> 16));
  attitude_.yaw_cdeg = times_q15(yaw, HALF_CIRCLE_CDEG);
}

uint16_t AttitudeFilter::age_ms(uint32_t now_us) const {
  const uint32_t age_us = now_us - newest_us_;
  if (!has_sample_ || age_us >= AGE_LIMIT_US) return AGE_LIMIT_MS;
  return static_cast<uint16_t>(age_us / 1000);
}

Reason AttitudeFilter::calibrate_gyro() {
  if (!is_valid()) return Reason::IMU_INVALID;
  if (!is_still()) return Reason::NOT_STILL;
  const int16_t* bias_q4 = stillness_.mean_q4();
  take_bias(bias_q4);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    // A count is 10 / 328 deg/s: sixteenths of counts to sixteenths of degrees per second.
    calibration_.gyro_bias_16[axis] =
        static_cast<int16_t>(product(bias_q4[axis], 10) / GYRO_PER_10_DEG_S);
  }
  is_bias_from_eeprom_ = false;
  is_looking_ = false;
  return Reason::NONE;
}

Reason AttitudeFilter::calibrate_level() {
  if (!is_valid()) return Reason::IMU_INVALID;
  if (!is_still()) return Reason::NOT_STILL;
  int16_t down[3];
  find_down(down);
  level_.tilt(down);
  const int16_t roll_cdeg = arc_tangent_cdeg(down[1], down[2]);
  const int16_t pitch_cdeg = arc_tangent_cdeg(negative(down[0]), length(down[1], down[2]));
  if (clamped16(roll_cdeg, Level::GREATEST_CDEG) != roll_cdeg ||
      clamped16(pitch_cdeg, Level::GREATEST_CDEG) != pitch_cdeg) {
    return Reason::OUT_OF_RANGE;
  }
  calibration_.level_roll_cdeg = roll_cdeg;
  calibration_.level_pitch_cdeg = pitch_cdeg;
  level_.set(roll_cdeg, pitch_cdeg);
  gravity_[0] = gravity_[1] = 0;
  gravity_[2] = ONE_Q30;
  find_angles();
  return Reason::NONE;
}

AttitudeState AttitudeFilter::state() const {
  AttitudeState state;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state.gravity_q30[axis] = gravity_[axis];
    state.gyro_bias_16[axis] = to_int16(bias_of(axis) / TURN_PER_16TH);
  }
  state.yaw_q = static_cast<int32_t>(yaw_);
  return state;
}

void AttitudeFilter::restore(const AttitudeState& state, uint32_t now_us) {
  begin();
  for (uint8_t axis = 0; axis < 3; ++axis) {
    gravity_[axis] = state.gravity_q30[axis];
    base_bias_[axis] = bias_of_16ths(state.gyro_bias_16[axis]);
    drift_[axis] = 0;
  }
  yaw_ = static_cast<uint32_t>(state.yaw_q);
  newest_us_ = now_us;
  has_sample_ = true;
  has_gravity_ = true;
  found_groups_ = SETTLED_GROUPS;
  is_looking_ = false;
  is_bias_from_eeprom_ = false;
  find_angles();
}

}  // namespace raspilot
