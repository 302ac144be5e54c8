#include "attitude_filter.h"

#include "angles.h"
#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr uint16_t STALE_SLOTS = 25;   // 50 ms
constexpr uint16_t LOST_SLOTS = 250;   // half a second
constexpr uint16_t MAX_AGE_SLOTS = 32767;
constexpr uint16_t SEARCH_SLOTS = 5000;
constexpr uint8_t FROZEN_COPIES = 24;  // with the one they copy 25 samples, 50 ms
constexpr uint8_t GOOD_ENOUGH = 10;
constexpr uint8_t SATURATED_SLOTS = 250;
// No aircraft and no sensor with a filter of 98 Hz turns 500 deg/s faster after 2 ms.
constexpr int8_t MAX_JUMP = 64;
// A senseless sample is forgotten after eight that make sense; after two none is believed until all
// but one are forgotten.
constexpr uint8_t DOUBT = 8;
constexpr uint8_t MAX_DISTRUST = 5 * DOUBT;
constexpr uint8_t MAX_PENDING_SLOTS = 25;
constexpr uint8_t STEPS_A_SLOT = 2;

// One gyro count (1 / 32.8 deg/s) for one slot is 1.0642e-6 rad: 4570.9 in Q32.
constexpr int16_t TURN_PER_COUNT = 4571;
// A sixteenth of a degree per second is 149923 in Q36.
constexpr int32_t BIAS_PER_16TH = 149923;
constexpr int16_t MAX_BIAS_16 = 32 * 16;
constexpr int32_t MAX_BIAS = MAX_BIAS_16 * BIAS_PER_16TH;
constexpr uint8_t BIAS_FRACTION = 4;
// Angles of a slot leave as Q19; one of them a slot is 0.87427 sixteenths of a degree per second.
constexpr int32_t TURN_TO_UPPER_HALF = 1 << 3;
constexpr int16_t ANGLE_REST = (1 << 13) - 1;
constexpr int16_t RATE_Q15 = 28648;

constexpr int32_t ONE_Q28 = 1L << 28;
constexpr int16_t ONE_Q14 = 1 << 14;
constexpr int16_t MIN_COSINE_SQUARED_Q14 = 820;  // pitch of 77 degrees: yaw means little above
constexpr uint16_t YAW_PER_Q17 = 5215;             // 2^32 / (2 pi) / 2^17
constexpr int16_t HALF_CIRCLE_CDEG = 18000;
// Straight up or down a bank means nothing: 0.2.
constexpr int16_t MIN_COS_PITCH = 3277;

// Four samples are collected for one look at the accelerometer, each at most 2 g an axis: halved
// and turned in any way they stay within 16 bits.
constexpr uint8_t GROUP = 4;
constexpr int16_t MAX_ACCEL = 8191;
constexpr int32_t ONE_Q26 = 1L << 26;
constexpr int32_t SQUARE_TOLERANCE_FINDING = static_cast<int32_t>(0.6 * ONE_Q26);  // 0.63 to 1.26 g
// Gravity is found by 2^-n of the difference every 8 ms.
constexpr uint8_t FINDING_SHIFT = 2;
constexpr uint8_t FINDING_GROUPS = 16;

// How far off the attitude may be (1 sigma, degrees) when it was found or kept, and the bias
// (tenths of a deg/s).
constexpr uint8_t FOUND_TILT = 3;
constexpr uint8_t STILL_TILT = 1;
constexpr uint8_t KEPT_TILT = 5;
constexpr uint8_t SATURATED_TILT = 1;
constexpr uint8_t MEASURED_BIAS = 1;
constexpr uint8_t KEPT_BIAS = 3;
constexpr uint8_t STORED_BIAS = 10;
constexpr uint8_t UNKNOWN_BIAS = 50;

}  // namespace

AttitudeFilter::AttitudeFilter(Calibration& calibration)
    : ZEROED_BASE(AttitudeMemory) calibration_(calibration) {}

void AttitudeFilter::begin() {
  has_begun_ = true;
  level_.set(calibration_->level_roll_cdeg, calibration_->level_pitch_cdeg);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int16_t bias_16 = clamped16(calibration_->gyro_bias_16[axis], MAX_BIAS_16);
    state_.bias_q36[axis] = bias_16 * BIAS_PER_16TH;
    // No gyro is without bias: three zeros are what EEPROM holds before one was measured.
    if (bias_16 != 0) state_.has_bias = true;
  }
  tilt_.begin(FOUND_TILT, state_.has_bias ? STORED_BIAS : UNKNOWN_BIAS, 0);
}

OUT_OF_LINE void AttitudeFilter::on_sample(const ImuSample& sample) {
  if (is_senseless(sample) || is_copy(sample)) {
    on_missing();
    return;
  }
  if (!has_begun_) begin();
  count_slots();
  const int16_t gyro[3] = {sample.gyro[0], negative(sample.gyro[1]), negative(sample.gyro[2])};
  if (searched_slots_ < SEARCH_SLOTS) ++searched_slots_;
  collect(sample);
  if ((phase_ & 1) != 0 && stillness_.on_sample(gyro) && !state_.has_ended_search) on_still();
  // The slot that looks at the accelerometer has no time for a second step.
  for (uint8_t step = phase_ == 0 ? 1 : 0; step < STEPS_A_SLOT && pending_slots_ != 0; ++step) {
    --pending_slots_;
    integrate(gyro);
  }
  TiltCorrection correction;
  if (phase_ == 0) {
    correct();
    normalize();
  } else if (tilt_.step(attitude_, correction)) {
    apply(correction);
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

OUT_OF_LINE void AttitudeFilter::on_missing() {
  if (missing_slots_ < MAX_AGE_SLOTS) ++missing_slots_;
  if (missing_slots_ < STALE_SLOTS) return;
  is_fresh_ = false;
  good_samples_ = 0;
  stillness_.reset();
  if (missing_slots_ == STALE_SLOTS) tilt_.widen(KEPT_TILT);
  if (missing_slots_ >= LOST_SLOTS) lose();
}

/** How the aircraft turned since is unknown: gravity is to be found again. */
void AttitudeFilter::lose() {
  if (has_gravity_) has_lost_gravity_ = true;
  has_gravity_ = false;
  found_groups_ = 0;
  pending_slots_ = 0;
}

/** A gyro at its end stop is a fast roll for half a second, and broken after that. */
bool AttitudeFilter::has_saturated_long(const ImuSample& sample) {
  if (!is_saturated(sample)) {
    saturated_slots_ = 0;
    return false;
  }
  if (saturated_slots_ == SATURATED_SLOTS) return true;
  ++saturated_slots_;
  tilt_.widen(SATURATED_TILT);
  return false;
}

/** Noise jumps about; a twelfth of it makes sense by chance. */
OUT_OF_LINE bool AttitudeFilter::is_senseless(const ImuSample& sample) {
  bool is_bad = is_garbage(sample) || has_saturated_long(sample);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    const int8_t rate = static_cast<int8_t>(sample.gyro[axis] >> 8);
    const int16_t jump = static_cast<int16_t>(rate - gyro_[axis]);
    if (clamped16(jump, MAX_JUMP) != jump) is_bad = true;
    gyro_[axis] = rate;
  }
  if (is_bad) {
    distrust_ = distrust_ < MAX_DISTRUST ? static_cast<uint8_t>(distrust_ + DOUBT) : MAX_DISTRUST;
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
  pending_slots_ = static_cast<uint8_t>(slots < MAX_PENDING_SLOTS ? slots : MAX_PENDING_SLOTS);
  missing_slots_ = 0;
  has_sample_ = true;
}

OUT_OF_LINE void AttitudeFilter::use_own_bias() {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.bias_q36[axis] = product(stillness_.mean_q4()[axis], TURN_PER_COUNT);
  }
  state_.has_bias = true;
  state_.has_own_bias = true;
  state_.has_ended_search = true;
  tilt_.begin(STILL_TILT, MEASURED_BIAS, tilt_.speed_m_s());
  // Until now the bias turned the attitude: gravity is what the still accelerometer shows.
  found_groups_ = 0;
}

/** The measured up direction, inverted: the chip's x forward, y left, z up. */
void AttitudeFilter::collect(const ImuSample& sample) {
  int16_t sign = -1;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    if (phase_ == 0) measured_[axis] = 0;
    const int16_t felt = clamped16(sample.accel[axis], MAX_ACCEL);
    measured_[axis] = static_cast<int16_t>(measured_[axis] + sign * felt);
    sign = 1;
  }
  phase_ = static_cast<uint8_t>((phase_ + 1) % GROUP);
  if (phase_ != 0) return;
  for (int16_t& sum : measured_) sum = static_cast<int16_t>(sum / 2);
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
  // A direction fixed to the earth turns against the aircraft.
  int32_t change[3];
  cross(down_, angle, change);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.gravity_q30[axis] += change[axis] >> 3;
    down_[axis] = upper_half(state_.gravity_q30[axis]);
  }
}

/** Heading turns by (q sin roll + r cos roll) / cos pitch; the division's rest is kept. */
void AttitudeFilter::integrate_yaw(const int16_t* angle) {
  yaw_change_ += (product(down_[1], angle[1]) + product(down_[2], angle[2])) >> 2;
  if ((phase_ & 1) == 0) return;
  int16_t cosine_squared = static_cast<int16_t>(ONE_Q14 - times_q14(down_[0], down_[0]));
  if (cosine_squared < MIN_COSINE_SQUARED_Q14) cosine_squared = MIN_COSINE_SQUARED_Q14;
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
  if (found_groups_ < FINDING_GROUPS) {
    if (has_lost_gravity_) {
      tilt_.take_out_turn(measured_[1], measured_[2], attitude_.pitch_rate_16,
                          attitude_.yaw_rate_16);
    }
    find_gravity();
    return;
  }
  int16_t difference[3];
  for (uint8_t axis = 0; axis < 3; ++axis) {
    difference[axis] = difference_of(measured_[axis], static_cast<int16_t>(down_[axis] / 2));
  }
  tilt_.collect(difference, attitude_.pitch_rate_16, attitude_.yaw_rate_16);
}

/** Moves gravity quickly to what the accelerometer measures. */
void AttitudeFilter::find_gravity() {
  const int32_t excess = dot(measured_, measured_) - ONE_Q26;
  if (clamped(excess, SQUARE_TOLERANCE_FINDING) != excess) return;
  for (uint8_t axis = 0; axis < 3; ++axis) {
    int32_t& gravity = state_.gravity_q30[axis];
    if (found_groups_ == 0) gravity = 0;
    gravity += product(measured_[axis], ONE_Q14) * 2 - shifted(gravity, FINDING_SHIFT);
  }
  if (++found_groups_ < FINDING_GROUPS) return;
  has_gravity_ = true;
  if (has_lost_gravity_) tilt_.lose();
}

void AttitudeFilter::apply(TiltCorrection& correction) {
  int32_t change[3];
  cross(down_, correction.rotation_q17, change);
  level_.tilt(correction.bias_q28);
  for (uint8_t axis = 0; axis < 3; ++axis) {
    state_.gravity_q30[axis] += change[axis] / 2;
    int32_t& bias = state_.bias_q36[axis];
    bias = clamped(bias + product(correction.bias_q28[axis], 256), MAX_BIAS);
  }
}

OUT_OF_LINE void AttitudeFilter::find_roll_and_yaw() {
  attitude_.roll_cdeg = arc_tangent_cdeg(down_[1], down_[2]);
  attitude_.yaw_cdeg = times_q15(static_cast<int16_t>(state_.yaw >> 16), HALF_CIRCLE_CDEG);
}

OUT_OF_LINE void AttitudeFilter::find_pitch() {
  const uint32_t level_square = static_cast<uint32_t>(product(down_[1], down_[1])) +
                                static_cast<uint32_t>(product(down_[2], down_[2]));
  int16_t level = static_cast<int16_t>(square_root(level_square));
  attitude_.sin_pitch = negative(down_[0]);
  attitude_.pitch_cdeg = arc_tangent_cdeg(attitude_.sin_pitch, level);
  if (level < MIN_COS_PITCH) level = MIN_COS_PITCH;
  attitude_.cos_pitch = level;
  attitude_.sin_roll = ratio_q14(down_[1], level);
  attitude_.cos_roll = ratio_q14(down_[2], level);
}

OUT_OF_LINE void AttitudeFilter::find_angles() {
  find_roll_and_yaw();
  find_pitch();
}

uint16_t AttitudeFilter::age_ms() const {
  if (!has_sample_ || missing_slots_ == MAX_AGE_SLOTS) return 65535;
  return static_cast<uint16_t>(missing_slots_ * 2);
}

bool AttitudeFilter::has_searched_long() const { return searched_slots_ == SEARCH_SLOTS; }

AttitudeState AttitudeFilter::state() const {
  AttitudeState state;
  static_cast<AttitudeFound&>(state) = state_;
  state.speed_m_s = tilt_.speed_m_s();
  return state;
}

void AttitudeFilter::restore(const AttitudeState& state) {
  begin();
  state_ = state;
  tilt_.begin(KEPT_TILT, state.has_bias ? KEPT_BIAS : UNKNOWN_BIAS, state.speed_m_s);
  has_sample_ = true;
  has_lost_gravity_ = true;
  find_down();
  // A reset may come before gravity was found.
  has_gravity_ = dot(down_, down_) > ONE_Q28 / 2;
  if (has_gravity_) found_groups_ = FINDING_GROUPS;
  find_angles();
}

}  // namespace raspilot
