#include "tilt_filter.h"

#include "angles.h"
#include "fixed_point.h"
#include "level.h"

namespace raspilot {

namespace {

constexpr float RAD = 0.01745329F;
constexpr float GRAVITY_M_S2 = 9.81F;

// A cycle: 64 slots of samples, then these pieces in three of four slots.
constexpr uint8_t GROUPS = 16;
constexpr uint8_t FIRST_OBSERVATION = 9;
constexpr uint8_t FIRST_ROW = 8;
constexpr uint8_t PIECES_AN_UPDATE = 15;
constexpr uint8_t SUBJECTS = 3;
constexpr float CYCLE_S = 0.286F;

constexpr float DEFAULT_SPEED_M_S = 13;
constexpr float MIN_SPEED_M_S = 5;
constexpr float MAX_SPEED_M_S = 40;

// Random walks in a cycle: tilt from rates that are rounded, bias from temperature, more at first,
// airspeed from gusts. They and the sigmas were searched for in flights in moderate turbulence.
constexpr float TILT_WALK = 0.0156F * RAD;
constexpr float BIAS_WALK = 0.0047F * RAD;
constexpr float EARLY_BIAS_WALK = 0.017F * RAD;
constexpr float SPEED_WALK = 0.41F;
constexpr uint8_t EARLY_CYCLES = 216;  // 62 s
// The bias drifts as it did in the last 56 s, later in the last 80 s. A constant turn cannot tell a
// drift about the vertical from an airspeed: the yaw gyro's fades.
constexpr float EARLY_DRIFT_SHARE = CYCLE_S / 56;
constexpr float DRIFT_SHARE = CYCLE_S / 80;
constexpr float YAW_DRIFT_KEPT = 1 - CYCLE_S / 190;

// 1 sigma of the observation, for one cycle.
constexpr float FORCE_SIGMA = 0.1435F;  // g, across the nose
constexpr float EXCESS_WEIGHT = 6.4F;   // a force is trusted less when it is not 1 g
constexpr float SPEED_SIGMA = 16.75F;   // m/s, about its mean
constexpr float MEASURED_SIGMA = 5;     // m/s: its error lasts for many cycles
constexpr int16_t MAX_OFF_CM_S = 800;   // a measurement that differs by more is wrong
constexpr float FIRST_SPEED_SHARE = 0.1F;
constexpr float MEAN_SPEED_SHARE = CYCLE_S / 570;
constexpr float LOAD_FACTOR_SIGMA = 0.093F;     // g, along down
constexpr float WEAK_LOAD_FACTOR_SIGMA = 0.3F;
constexpr float LOST_FORCE_SIGMA = 0.375F;  // g, along the nose: a change of airspeed
constexpr float STRAIGHT_SIGMA = 2.8F * RAD;   // rad/s: in straight flight a turn is mostly bias
constexpr float STRAIGHT_LIMIT = 5.2F * RAD;  // a faster one is a turn

constexpr float FORCE_UNIT = 1 / 8192.0F;
constexpr int16_t ONE_Q14 = 16384;
constexpr float ONE_Q17 = 131072;
/** rad/s in rad a slot Q28. */
constexpr float BIAS_TO_Q28 = 536870.9F;
/** m/s and sixteenths of a deg/s in g Q13, times 512. */
constexpr float SPEED_TO_FORCE = RAD / 16 / GRAVITY_M_S2 * 8192 * 512;
constexpr int16_t TWO_G_Q13 = 16383;
/** A force beyond 1 g by more than this does not mean a change of airspeed: a launch, a loop. */
constexpr int16_t MAX_EXCESS_Q13 = 1434;
/** More load than this is a pull-up: it does not end within a cycle or two. */
constexpr int16_t MAX_LOAD_FACTOR_ERROR_Q13 = 2048;
/**
 * A force of 1 g that differs by 30 degrees is a gust; for 3 s it is an attitude that is lost. In
 * each cycle of the next 8.6 s the tilt may then change by LOST_WALK.
 */
constexpr int16_t FAR_OFF_Q13 = 4096;
constexpr uint8_t LOST_CYCLES = 10;
constexpr uint8_t FOUND_CYCLES = LOST_CYCLES + 30;
constexpr float LOST_WALK = 2.5F * RAD;

OUT_OF_LINE void add_product(float* sum, const float* a, float b) { *sum += *a * b; }

OUT_OF_LINE float sane_speed(float speed_m_s) {
  if (speed_m_s < MIN_SPEED_M_S) return MIN_SPEED_M_S;
  return speed_m_s > MAX_SPEED_M_S ? MAX_SPEED_M_S : speed_m_s;
}

OUT_OF_LINE float square(float value) { return value * value; }

OUT_OF_LINE float from_fixed(int16_t value, float unit) { return value * unit; }

OUT_OF_LINE int16_t to_fixed(float value, float scale) {
  return to_int16(static_cast<int32_t>(value * scale));
}

/** Adds a force that is a rate times SPEED_TO_FORCE. */
OUT_OF_LINE void add_force(int16_t& sum_q13, int32_t force) {
  sum_q13 = clamped16(sum_of(sum_q13, to_int16(shifted(force, 9))), TWO_G_Q13);
}

}  // namespace

OUT_OF_LINE float& TiltFilter::covariance(uint8_t row, uint8_t column) {
  const uint8_t low = row < column ? row : column;
  const uint8_t high = row < column ? column : row;
  return covariance_[static_cast<uint8_t>(high * (high + 1)) / 2 + low];
}

bool TiltFilter::is_lost() const { return lost_cycles_ >= LOST_CYCLES; }

OUT_OF_LINE void TiltFilter::restart() {
  groups_ = 0;
  piece_ = 0;
  for (int32_t& sum : sums_) sum = 0;
}

/** Adds to the variances of tilt, bias and speed. */
OUT_OF_LINE void TiltFilter::add_noise(float tilt, float bias, float speed) {
  for (uint8_t state = 0; state < STATES; ++state) {
    covariance(state, state) += square(state < BIAS_X ? tilt : state < SPEED ? bias : speed);
    change_[state] = 0;
  }
}

OUT_OF_LINE void TiltFilter::begin(uint8_t tilt_deg, uint8_t bias_10, float speed_m_s) {
  // Zero, and no piece of a cycle: as its owner made it.
  uint8_t* const bytes = reinterpret_cast<uint8_t*>(this);
  for (uint8_t at = 0; at < sizeof *this; ++at) bytes[at] = 0;
  add_noise(from_fixed(tilt_deg, RAD), from_fixed(bias_10, RAD / 10), 7);
  mean_share_ = FIRST_SPEED_SHARE;
  speed_ = mean_speed_ = speed_m_s >= MIN_SPEED_M_S ? speed_m_s : DEFAULT_SPEED_M_S;
}

OUT_OF_LINE void TiltFilter::widen(uint8_t tilt_deg) {
  restart();
  add_noise(from_fixed(tilt_deg, RAD), 0, 0);
}

void TiltFilter::lose() { lost_cycles_ = LOST_CYCLES; }

void TiltFilter::collect(const int16_t* difference_q13, int16_t pitch_rate_16,
                         int16_t yaw_rate_16) {
  if (groups_ == GROUPS) return;
  ++groups_;
  for (uint8_t axis = 0; axis < 3; ++axis) sums_[axis] += difference_q13[axis];
  sums_[PITCH_RATE] += pitch_rate_16;
  sums_[YAW_RATE] += yaw_rate_16;
}

/** State `to` grows by `factor` times state `from`. */
OUT_OF_LINE void TiltFilter::add(uint8_t to, uint8_t from, float factor) {
  // In this order the variance gains 2 * factor * covariance + factor^2 * variance of `from`.
  add_product(&covariance(to, to), &covariance(to, from), factor);
  for (uint8_t other = 0; other < STATES; ++other) {
    if (other != to) add_product(&covariance(to, other), &covariance(from, other), factor);
  }
  add_product(&covariance(to, to), &covariance(to, from), factor);
}

OUT_OF_LINE int16_t TiltFilter::take_out_turn(int16_t& right_q13, int16_t& down_q13,
                                              int16_t pitch_rate_16, int16_t yaw_rate_16) const {
  const int16_t per_rate = to_fixed(speed_, SPEED_TO_FORCE);
  add_force(right_q13, product(yaw_rate_16, per_rate));
  add_force(down_q13, -product(pitch_rate_16, per_rate));
  return per_rate;
}

OUT_OF_LINE int16_t TiltFilter::mean(Sum sum) const { return to_int16(shifted(sums_[sum], 4)); }

/** The forces across the nose without the turn's, and the turn. */
OUT_OF_LINE void TiltFilter::find_turn(const Attitude& attitude) {
  int16_t pitch_rate = mean(PITCH_RATE);
  int16_t yaw_rate = mean(YAW_RATE);
  roll_error_ = mean(Y);
  pitch_error_ = mean(Z);
  const int16_t per_rate = take_out_turn(roll_error_, pitch_error_, pitch_rate, yaw_rate);
  turn(yaw_rate, pitch_rate, attitude.sin_roll, attitude.cos_roll);
  load_factor_error_ = 0;
  add_force(load_factor_error_, product(pitch_rate, per_rate));
  turn_rate_ = from_fixed(yaw_rate, RAD / 16);
}

/** The attitude's errors as they were in this cycle, and how far they can be trusted. */
OUT_OF_LINE void TiltFilter::find_errors(const Attitude& attitude) {
  int16_t x = mean(X);
  int16_t y = roll_error_;
  int16_t z = pitch_error_;
  turn(z, y, attitude.sin_roll, attitude.cos_roll);
  roll_error_ = y;
  turn(x, z, attitude.sin_pitch, attitude.cos_pitch);
  pitch_error_ = negative(x);
  load_factor_error_ = sum_of(load_factor_error_, z);
  // Half of what the square of the force exceeds 1 g by: a tilt error does not change it.
  const int16_t parts[3] = {static_cast<int16_t>(x / 2), static_cast<int16_t>(y / 2),
                            static_cast<int16_t>(z / 2)};
  const int16_t excess = sum_of(z, to_int16(shifted(dot(parts, parts), 12)));
  noise_ = square(FORCE_SIGMA) + square(from_fixed(excess, EXCESS_WEIGHT * FORCE_UNIT));
  const bool is_far_off = clamped16(x, FAR_OFF_Q13) != x || clamped16(y, FAR_OFF_Q13) != y;
  is_one_g_ = clamped16(excess, MAX_EXCESS_Q13) == excess;
  // Without 1 g a gust or a launch: neither lost nor found.
  if (!is_one_g_ && !is_lost()) return;
  ++lost_cycles_;
  if (lost_cycles_ <= LOST_CYCLES ? !is_far_off : lost_cycles_ == FOUND_CYCLES) lost_cycles_ = 0;
}

/** Tilt errors turn with the heading and grow with the bias; speed follows the force. */
OUT_OF_LINE void TiltFilter::predict(uint8_t piece, const Attitude& attitude) {
  float factor = turn_rate_ * CYCLE_S;
  uint8_t to = ROLL;
  uint8_t from = PITCH;
  switch (piece) {
    case 0:
    case 1: return;
    case 2:
      from = BIAS_X;
      factor = -CYCLE_S;
      break;
    case 3: break;
    case 4:
      to = PITCH;
      from = ROLL;
      factor = -factor;
      break;
    case 5:
      to = PITCH;
      from = BIAS_Y;
      factor = from_fixed(attitude.cos_roll, -CYCLE_S / ONE_Q14);
      break;
    case 6:
      to = PITCH;
      from = BIAS_Z;
      factor = from_fixed(attitude.sin_roll, CYCLE_S / ONE_Q14);
      break;
    case 7:
      if (!is_one_g_) return;
      to = SPEED;
      factor = -GRAVITY_M_S2 * CYCLE_S;
      speed_ -= from_fixed(pitch_error_, -GRAVITY_M_S2 * CYCLE_S * FORCE_UNIT);
      break;
    default:
      add_noise(is_lost() ? LOST_WALK : TILT_WALK,
                cycles_ < EARLY_CYCLES ? EARLY_BIAS_WALK : BIAS_WALK, SPEED_WALK);
      return;
  }
  add(to, from, factor);
}

/** A tilt that a force shows, Q13. */
OUT_OF_LINE void TiltFilter::observe(State tilt, int16_t error) {
  weights_[tilt] = 1;
  innovation_ = from_fixed(error, FORCE_UNIT);
}

/** Speed as measured or its mean, roll by the force across the nose, no turn in straight flight. */
OUT_OF_LINE void TiltFilter::begin_observation(uint8_t subject, const Attitude& attitude) {
  float per_bias = 1 / static_cast<float>(ONE_Q14);
  if (subject == 0) {
    const int16_t off_cm_s = sum_of(measured_cm_s_, to_fixed(speed_, -100));
    is_measured_ = measured_cm_s_ != 0 && clamped16(off_cm_s, MAX_OFF_CM_S) == off_cm_s;
    measured_cm_s_ = 0;
    float sigma = LOST_FORCE_SIGMA;
    if (is_lost() && !is_measured_) {
      observe(PITCH, pitch_error_);
    } else {
      weights_[SPEED] = 1;
      innovation_ = mean_speed_ - speed_;
      sigma = SPEED_SIGMA;
      if (is_measured_) {
        innovation_ = from_fixed(off_cm_s, 0.01F);
        sigma = MEASURED_SIGMA;
      }
    }
    variance_ = square(sigma);
    return;
  }
  if (subject == 1) {
    per_bias = speed_ * (1 / GRAVITY_M_S2 / ONE_Q14);
    observe(ROLL, roll_error_);
    weights_[SPEED] = turn_rate_ * (-1 / GRAVITY_M_S2);
    variance_ = noise_;
  } else {
    const float steep = square(turn_rate_ * (1 / STRAIGHT_LIMIT));
    if (steep > 1) {
      // The wings carry 1 g on average: more of it shows a roll error as part of the turn's force.
      // A climb that begins carries more than 1 g, too: with a measured airspeed it counts less.
      observe(ROLL, load_factor_error_);
      weights_[ROLL] = turn_rate_ * speed_ * (1 / GRAVITY_M_S2);
      if (clamped16(load_factor_error_, MAX_LOAD_FACTOR_ERROR_Q13) != load_factor_error_) {
        weights_[ROLL] = 0;
      }
      variance_ =
          square(is_measured_ || is_lost() ? WEAK_LOAD_FACTOR_SIGMA : LOAD_FACTOR_SIGMA);
      return;
    }
    innovation_ = turn_rate_;
    variance_ = square(STRAIGHT_SIGMA + STRAIGHT_SIGMA * 8 * steep);
  }
  weights_[BIAS_Y] = from_fixed(attitude.sin_roll, per_bias);
  weights_[BIAS_Z] = from_fixed(attitude.cos_roll, per_bias);
}

/** A part of an update by one observation. */
OUT_OF_LINE void TiltFilter::update(uint8_t piece) {
  if (piece < STATES) {
    for (uint8_t state = 0; state < STATES; ++state) {
      if (piece == 0) gains_[state] = 0;
      add_product(&gains_[state], &covariance(state, piece), weights_[piece]);
    }
    return;
  }
  if (piece < FIRST_ROW) {
    for (uint8_t state = 0; state < STATES; ++state) {
      if (piece == STATES) {
        add_product(&variance_, &gains_[state], weights_[state]);
      } else {
        add_product(&innovation_, &change_[state], -weights_[state]);
        weights_[state] = 0;
      }
    }
    if (piece != STATES) variance_ = 1 / variance_;
    return;
  }
  const uint8_t row = static_cast<uint8_t>(piece - FIRST_ROW);
  const float gain = gains_[row] * variance_;
  add_product(&change_[row], &innovation_, gain);
  for (uint8_t column = 0; column <= row; ++column) {
    add_product(&covariance(row, column), &gains_[column], -gain);
  }
}

OUT_OF_LINE bool TiltFilter::step(const Attitude& attitude, TiltCorrection& correction) {
  if (groups_ < GROUPS) return false;
  uint8_t piece = piece_++;
  if (piece == 0) find_turn(attitude);
  if (piece == 1) find_errors(attitude);
  if (piece < FIRST_OBSERVATION) {
    predict(piece, attitude);
    return false;
  }
  piece = static_cast<uint8_t>(piece - FIRST_OBSERVATION);
  uint8_t subject = 0;
  for (; piece >= PIECES_AN_UPDATE; piece = static_cast<uint8_t>(piece - PIECES_AN_UPDATE)) ++subject;
  if (subject == SUBJECTS) return finish(piece, attitude, correction);
  if (piece == 0) {
    begin_observation(subject, attitude);
  } else {
    update(static_cast<uint8_t>(piece - 1));
  }
  return false;
}

/** Gives the correction part by part; starts over when rounding has spoilt the covariance. */
OUT_OF_LINE bool TiltFilter::finish(uint8_t piece, const Attitude& attitude,
                                    TiltCorrection& correction) {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    correction.rotation_q17[axis] = correction.bias_q28[axis] = 0;
  }
  if (piece == 0) {
    for (uint8_t state = 0; state < STATES; ++state) {
      if (covariance(state, state) > 0) continue;
      begin(10, 10, 0);
      return false;
    }
    correction.rotation_q17[0] = to_fixed(change_[ROLL], ONE_Q17);
    correction.rotation_q17[1] = to_fixed(change_[PITCH], ONE_Q17);
    turn(correction.rotation_q17[1], correction.rotation_q17[2], attitude.sin_roll,
         attitude.cos_roll);
    return true;
  }
  const bool is_early = cycles_ < EARLY_CYCLES;
  if (piece <= 3) {
    const uint8_t axis = static_cast<uint8_t>(piece - 1);
    const float* const change = &change_[BIAS_X + axis];
    if (piece == 3) drift_[axis] *= YAW_DRIFT_KEPT;  // yaw
    add_product(&drift_[axis], change, is_early ? EARLY_DRIFT_SHARE : DRIFT_SHARE);
    correction.bias_q28[axis] = to_fixed(*change + drift_[axis], BIAS_TO_Q28);
    return true;
  }
  if (is_early) ++cycles_;
  speed_ = sane_speed(speed_ + change_[SPEED]);
  // The mean of all that was flown, and after minutes of the last ones.
  mean_share_ = mean_share_ / (1 + mean_share_);
  if (mean_share_ < MEAN_SPEED_SHARE) mean_share_ = MEAN_SPEED_SHARE;
  mean_speed_ += (speed_ - mean_speed_) * mean_share_;
  restart();
  return false;
}

}  // namespace raspilot
