#include "level.h"

#include "angles.h"
#include "fixed_point.h"

namespace raspilot {

OUT_OF_LINE void turn(int16_t& a, int16_t& b, int16_t sine, int16_t cosine) {
  const int16_t before = a;
  a = from_q14(product(a, cosine) + product(b, sine));
  b = from_q14(product(b, cosine) - product(before, sine));
}

constexpr int16_t Level::MAX_CDEG;

OUT_OF_LINE void Level::set(int16_t roll_cdeg, int16_t pitch_cdeg) {
  const int16_t roll = clamped16(roll_cdeg, MAX_CDEG);
  const int16_t pitch = clamped16(pitch_cdeg, MAX_CDEG);
  roll_sine_ = small_sine_q14(roll);
  roll_cosine_ = small_cosine_q14(roll);
  pitch_sine_ = small_sine_q14(pitch);
  pitch_cosine_ = small_cosine_q14(pitch);
}

OUT_OF_LINE void Level::straighten(int16_t* vector) const {
  turn(vector[1], vector[2], static_cast<int16_t>(-roll_sine_), roll_cosine_);
  turn(vector[0], vector[2], pitch_sine_, pitch_cosine_);
}

OUT_OF_LINE void Level::tilt(int16_t* vector) const {
  turn(vector[0], vector[2], static_cast<int16_t>(-pitch_sine_), pitch_cosine_);
  turn(vector[1], vector[2], roll_sine_, roll_cosine_);
}

}  // namespace raspilot
