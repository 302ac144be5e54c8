#include "attitude_filter.h"

#include "angles.h"
#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr uint16_t STALE_SLOTS = 25;   // 50 ms
constexpr uint16_t LOST_SLOTS = 250;   // half a second
constexpr uint16_t OLDEST_SLOTS = 32767;
constexpr uint16_t SEARCH_SLOTS = 5000;
constexpr uint8_t FROZEN_COPIES = 24;  // with the one they copy 25 samples, 50 ms
constexpr uint8_t GOOD_ENOUGH = 10;
// No aircraft and no sensor with a filter of 98 Hz turns 500 deg/s faster after 2 ms.
constexpr int8_t GREATEST_JUMP = 64;
// A senseless sample is forgotten after eight that make sense; after two none is believed until all
// but one are forgotten.
constexpr uint8_t DOUBT = 8;
constexpr uint8_t MOST_DISTRUST = 5 * DOUBT;
constexpr uint8_t MOST_PENDING_SLOTS = 25;
constexpr uint8_t STEPS_A_SLOT = 2;

// One gyro count (1 / 32.8 deg/s) for one slot is 1.0642e-6 rad: 4570.9 in Q32.
constexpr int16_t TURN_PER_COUNT = 4571;
// A sixteenth of a degree per second is 149923 in Q36.
constexpr int32_t BIAS_PER_16TH = 149923;
constexpr int16_t GREATEST_BIAS_16 = 32 * 16;
constexpr int32_t GREATEST_BIAS = GREATEST_BIAS_16 * BIAS_PER_16TH;
constexpr uint8_t BIAS_FRACTION = 4;
// A sixteenth of a count in sixteenths of a deg/s, Q15.
constexpr int16_t COUNT_TO_DEG_S = 999;
// Angles of a slot leave as Q19; one of them a slot is 0.87427 sixteenths of a degree per second.
constexpr int32_t TURN_TO_UPPER_HALF = 1 << 3;
constexpr int16_t ANGLE_REST = (1 << 13) - 1;
constexpr int16_t RATE_Q15 = 28648;

constexpr int32_t ONE_Q30 = 1L << 30;
constexpr int32_t ONE_Q28 = 1L << 28;
constexpr int16_t ONE_Q14 = 1 << 14;
constexpr int16_t LEAST_COSINE_SQUARED_Q14 = 820;  // pitch of 77 degrees: yaw means little above
constexpr uint16_t YAW_PER_Q17 = 5215;             // 2^32 / (2 pi) / 2^17
constexpr int16_t HALF_CIRCLE_CDEG = 18000;

// Four samples are collected for one look at the accelerometer, each at most 1.15 g an axis:
// turned in any way they stay within 16 bits.
constexpr uint8_t GROUP = 4;
constexpr int16_t GREATEST_ACCEL = 4700;
constexpr int32_t SQUARE_TOLERANCE = static_cast<int32_t>(0.2 * ONE_Q28);          // 0.9 to 1.1 g
constexpr int32_t SQUARE_TOLERANCE_FINDING = static_cast<int32_t>(0.6 * ONE_Q28);  // 0.63 to 1.26 g

// The accelerometer draws gravity by 2^-n of the difference every 8 ms.
constexpr uint8_t FINDING_SHIFT = 2;
constexpr uint8_t SETTLING_SHIFT = 7;  // 1.0 s
constexpr uint8_t FLYING_SHIFT = 11;   // 16.4 s
constexpr uint8_t FINDING_GROUPS = 16;
constexpr uint8_t SETTLED_GROUPS = 250;

// The bias is learned with a quarter of the square of the draw's rate: just too slow to swing.
constexpr int16_t LEARNING_DIVISOR = 4;

// A turn of more than 2.5 deg/s about the vertical, low-passed with 0.5 s, tilts what the
// accelerometer takes for down.
constexpr uint8_t TURN_SHIFT = 6;
constexpr int32_t TURN_LIMIT = 46L << TURN_SHIFT;

}  // namespace

AttitudeFilter::AttitudeFilter(Calibration& calibration)
    : AttitudeMemory(), calibration_(calibration) {}

void AttitudeFilter::begin() {
  has_begun_ = true;
  level_.set(calibration_.level_roll_cdeg, calibration_.level_pitch_cdeg);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.bias_q36[axis] =
        clamped16(calibration_.gyro_bias_16[axis], GREATEST_BIAS_16) * BIAS_PER_16TH;
  }
}

OUT_OF_LINE void AttitudeFilter::on_sample(const ImuSample& sample, uint32_t) {
  if (is_senseless(sample) || is_copy(sample)) {
    miss();
    return;
  }
  if (!has_begun_) begin();
  count_slots();
  const int16_t gyro[3] = {sample.gyro[0], negative(sample.gyro[1]), negative(sample.gyro[2])};
  if (searched_slots_ < SEARCH_SLOTS) ++searched_slots_;
  collect(sample);
  const bool is_looking = !has_ended_search_ && searched_slots_ < SEARCH_SLOTS;
  if ((phase_ & 1) != 0 && stillness_.on_sample(gyro) && is_looking) take_own_bias();
  // The slot that looks at the accelerometer has no time for a second step.
  for (uint8_t step = phase_ == 0 ? 1 : 0; step < STEPS_A_SLOT && pending_slots_ != 0; ++step) {
    --pending_slots_;
    integrate(gyro);
  }
  if (phase_ == 0) {
    correct();
    normalize();
  }
  if ((phase_ & 1) != 0) {
    find_roll_and_yaw();
  } else {
    find_pitch();
  }
  if (good_samples_ < GOOD_ENOUGH) {
    ++good_samples_;
  } else {
    is_fresh_ = true;
  }
}

void AttitudeFilter::on_missing(uint32_t) { miss(); }

OUT_OF_LINE void AttitudeFilter::miss() {
  if (missing_slots_ < OLDEST_SLOTS) ++missing_slots_;
  if (missing_slots_ < STALE_SLOTS) return;
  is_fresh_ = false;
  good_samples_ = 0;
  stillness_.forget();
  // How it turned meanwhile is not known: the accelerometer draws quickly for a while.
  if (found_groups_ > FINDING_GROUPS) found_groups_ = FINDING_GROUPS;
  if (missing_slots_ >= LOST_SLOTS) lose();
}

/** What turned meanwhile is not known any more: gravity is to be found anew. */
void AttitudeFilter::lose() {
  has_gravity_ = false;
  found_groups_ = 0;
  pending_slots_ = 0;
}

/** Noise jumps about; a twelfth of it makes sense by chance. */
OUT_OF_LINE bool AttitudeFilter::is_senseless(const ImuSample& sample) {
  bool is_bad = is_garbage(sample);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int8_t rate = static_cast<int8_t>(sample.gyro[axis] >> 8);
    const int16_t jump = static_cast<int16_t>(rate - gyro_[axis]);
    if (clamped16(jump, GREATEST_JUMP) != jump) is_bad = true;
    gyro_[axis] = rate;
  }
  if (is_bad) {
    distrust_ = distrust_ < MOST_DISTRUST ? static_cast<uint8_t>(distrust_ + DOUBT) : MOST_DISTRUST;
  } else if (distrust_ != 0) {
    --distrust_;
  }
  return is_bad || distrust_ > DOUBT;
}

OUT_OF_LINE bool AttitudeFilter::is_copy(const ImuSample& sample) {
  const uint16_t print = fingerprint(sample);
  const bool is_same = has_sample_ && print == print_;
  print_ = print;
  if (!is_same) copies_ = 0;
  if (copies_ < FROZEN_COPIES) {
    if (is_same) ++copies_;
    if (copies_ < FROZEN_COPIES) return false;
  }
  // They came in time, and yet the attitude is as old as the first of them.
  is_fresh_ = false;
  good_samples_ = 0;
  return true;
}

/** More than one sample that was missed is made up for in the slots to come. */
OUT_OF_LINE void AttitudeFilter::count_slots() {
  const uint16_t slots = static_cast<uint16_t>(pending_slots_ + missing_slots_ + 1);
  pending_slots_ = static_cast<uint8_t>(slots < MOST_PENDING_SLOTS ? slots : MOST_PENDING_SLOTS);
  missing_slots_ = 0;
  has_sample_ = true;
}

OUT_OF_LINE void AttitudeFilter::take_own_bias() {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.bias_q36[axis] = product(stillness_.mean_q4()[axis], TURN_PER_COUNT);
  }
  state_.has_own_bias = true;
  has_ended_search_ = true;
}

/** What is felt as up, turned over: the chip's x forward, y left, z up. */
void AttitudeFilter::collect(const ImuSample& sample) {
  int16_t sign = -1;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    if (phase_ == 0) measured_[axis] = 0;
    const int16_t felt = clamped16(sample.accel[axis], GREATEST_ACCEL);
    measured_[axis] = static_cast<int16_t>(measured_[axis] + sign * felt);
    sign = 1;
  }
  phase_ = static_cast<uint8_t>((phase_ + 1) % GROUP);
}

void AttitudeFilter::integrate(const int16_t* gyro) {
  int16_t angle[3];
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int32_t turn = product(gyro[axis], TURN_PER_COUNT) -
                         (state_.bias_q36[axis] >> BIAS_FRACTION) + remainder_[axis];
    angle[axis] = static_cast<int16_t>((turn * TURN_TO_UPPER_HALF) >> 16);
    remainder_[axis] = static_cast<int16_t>(static_cast<int16_t>(turn) & ANGLE_REST);
  }
  level_.straighten(angle);
  attitude_.roll_rate_16 = times_q15(angle[0], RATE_Q15);
  attitude_.pitch_rate_16 = times_q15(angle[1], RATE_Q15);
  attitude_.yaw_rate_16 = times_q15(angle[2], RATE_Q15);
  integrate_yaw(angle);
  // What is fixed to the earth turns against the aircraft.
  int32_t change[3];
  cross(down_, angle, change);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.gravity_q30[axis] += change[axis] >> 3;
    down_[axis] = upper_half(state_.gravity_q30[axis]);
  }
  if (phase_ == 0) {
    turn_rate_ += from_q14(dot(down_, angle)) - shifted(turn_rate_, TURN_SHIFT);
  }
}

/** Heading turns by (q sin roll + r cos roll) / cos pitch; the division's rest is kept. */
void AttitudeFilter::integrate_yaw(const int16_t* angle) {
  yaw_change_ += (product(down_[1], angle[1]) + product(down_[2], angle[2])) >> 2;
  if ((phase_ & 1) == 0) return;
  int16_t cosine_squared = static_cast<int16_t>(ONE_Q14 - times_q14(down_[0], down_[0]));
  if (cosine_squared < LEAST_COSINE_SQUARED_Q14) cosine_squared = LEAST_COSINE_SQUARED_Q14;
  const int32_t change_q17 = yaw_change_ / cosine_squared;
  yaw_change_ %= cosine_squared;
  state_.yaw += static_cast<uint32_t>(change_q17) * YAW_PER_Q17;
}

/** One step of Newton's towards the length 1. */
void AttitudeFilter::normalize() {
  find_down();
  const int16_t half_lack_q16 = to_int16(shifted(ONE_Q28 - dot(down_, down_), 13));
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.gravity_q30[axis] += product(down_[axis], half_lack_q16);
  }
}

OUT_OF_LINE void AttitudeFilter::find_down() {
  for (uint8_t axis = 0; axis < 3; ++axis) down_[axis] = upper_half(state_.gravity_q30[axis]);
}

void AttitudeFilter::correct() {
  level_.straighten(measured_);
  const int32_t excess = dot(measured_, measured_) - ONE_Q28;
  if (found_groups_ < FINDING_GROUPS) {
    if (clamped(excess, SQUARE_TOLERANCE_FINDING) != excess) return;
    if (found_groups_ == 0) {
      for (uint8_t axis = 0; axis < 3; ++axis) state_.gravity_q30[axis] = 0;
    }
    draw(FINDING_SHIFT);
    has_gravity_ = ++found_groups_ == FINDING_GROUPS;
    return;
  }
  const bool is_settling = found_groups_ < SETTLED_GROUPS;
  if (is_settling) ++found_groups_;
  const bool is_one_g = clamped(excess, SQUARE_TOLERANCE) == excess;
  const bool is_turning = clamped(turn_rate_, TURN_LIMIT) != turn_rate_;
  if (!is_one_g || is_turning) return;
  draw(is_settling ? SETTLING_SHIFT : FLYING_SHIFT);
  if (!is_settling) learn_drift();
}

/** Moves gravity by 2^-shift of the way to what was measured. */
void AttitudeFilter::draw(uint8_t shift) {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    int32_t& gravity = state_.gravity_q30[axis];
    gravity += shifted(measured_[axis] * 65536L, shift) - shifted(gravity, shift);
  }
}

/** The rotation that leads to what was measured, summed up, is what the gyro reads too much. */
void AttitudeFilter::learn_drift() {
  int32_t rotation[3];
  int16_t error[3];
  cross(measured_, down_, rotation);
  for (uint8_t axis = 0; axis < 3; ++axis) error[axis] = upper_half(rotation[axis]);
  level_.tilt(error);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    int32_t& bias = state_.bias_q36[axis];
    bias = clamped(bias - error[axis] / LEARNING_DIVISOR, GREATEST_BIAS);
  }
}

OUT_OF_LINE void AttitudeFilter::find_roll_and_yaw() {
  attitude_.roll_cdeg = arc_tangent_cdeg(down_[1], down_[2]);
  attitude_.yaw_cdeg = times_q15(static_cast<int16_t>(state_.yaw >> 16), HALF_CIRCLE_CDEG);
}

OUT_OF_LINE void AttitudeFilter::find_pitch() {
  const uint32_t level_square = static_cast<uint32_t>(product(down_[1], down_[1])) +
                                static_cast<uint32_t>(product(down_[2], down_[2]));
  const int16_t level = static_cast<int16_t>(square_root(level_square));
  attitude_.pitch_cdeg = arc_tangent_cdeg(negative(down_[0]), level);
}

OUT_OF_LINE void AttitudeFilter::find_angles() {
  find_roll_and_yaw();
  find_pitch();
}

uint16_t AttitudeFilter::age_ms(uint32_t) const {
  if (!has_sample_ || missing_slots_ == OLDEST_SLOTS) return 65535;
  return static_cast<uint16_t>(missing_slots_ * 2);
}

bool AttitudeFilter::is_calibrating() const {
  return !has_ended_search_ && searched_slots_ < SEARCH_SLOTS;
}

Reason AttitudeFilter::refusal() const {
  if (!is_valid()) return Reason::IMU_INVALID;
  return is_still() ? Reason::NONE : Reason::NOT_STILL;
}

Reason AttitudeFilter::calibrate_gyro() {
  if (refusal() != Reason::NONE) return refusal();
  take_own_bias();
  for (uint8_t axis = 0; axis < 3; ++axis) {
    calibration_.gyro_bias_16[axis] = times_q15(stillness_.mean_q4()[axis], COUNT_TO_DEG_S);
  }
  return Reason::NONE;
}

Reason AttitudeFilter::calibrate_level() {
  if (refusal() != Reason::NONE) return refusal();
  // The sensor's own angles: as if nothing had been level before.
  level_.tilt(down_);
  find_angles();
  const bool is_in_range =
      clamped16(attitude_.roll_cdeg, Level::GREATEST_CDEG) == attitude_.roll_cdeg &&
      clamped16(attitude_.pitch_cdeg, Level::GREATEST_CDEG) == attitude_.pitch_cdeg;
  if (is_in_range) {
    calibration_.level_roll_cdeg = attitude_.roll_cdeg;
    calibration_.level_pitch_cdeg = attitude_.pitch_cdeg;
    level_.set(attitude_.roll_cdeg, attitude_.pitch_cdeg);
    state_.gravity_q30[0] = state_.gravity_q30[1] = 0;
    state_.gravity_q30[2] = ONE_Q30;
  }
  find_down();
  find_angles();
  return is_in_range ? Reason::NONE : Reason::OUT_OF_RANGE;
}

void AttitudeFilter::restore(const AttitudeState& state, uint32_t) {
  begin();
  state_ = state;
  has_sample_ = true;
  has_gravity_ = true;
  found_groups_ = SETTLED_GROUPS;
  has_ended_search_ = true;
  find_down();
  find_angles();
}

}  // namespace raspilot
