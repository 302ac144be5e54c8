#include "pid.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr uint8_t P_BITS = 10;
// A slot of 2000 us is 1.024 / 512 s: the 512th is a shift, 1.024 is 1049 / 1024.
constexpr uint8_t I_BITS = 15;
constexpr uint16_t I_FACTOR = 1049;
// 2^-4 of a change a slot times 2^-14 of D is 2^-18; 500 slots a second and the 2 at the end make
// that 2^-10: 500 / 256 / 2 is 125 / 128.
constexpr uint8_t D_BITS = 14;
constexpr uint8_t D_FACTOR = 125;
constexpr uint32_t MAX_D = 65535;

constexpr uint8_t INTEGRAL_BITS = 6;
// Six times every limit when it is a derivative, and the greatest P still fits beside it.
constexpr int32_t MAX_SLOPE = 50000000L;
// No aircraft turns by this much in a slot: the angle went round the circle.
constexpr int16_t MAX_CHANGE = 1000;

/** A gain of 0 to 50 times 2^bits, rounded down. */
OUT_OF_LINE int32_t to_fixed(float gain, uint8_t bits) {
  return static_cast<int32_t>(gain * static_cast<float>(1L << bits));
}

}  // namespace

OUT_OF_LINE void Pid::tune(const PidGains& gains) {
  p_ = static_cast<uint16_t>(to_fixed(gains.p, P_BITS));
  i_ = static_cast<uint16_t>(static_cast<uint32_t>(to_fixed(gains.i, I_BITS)) * I_FACTOR >> I_BITS);
  const uint32_t d = static_cast<uint32_t>(to_fixed(gains.d, D_BITS)) * D_FACTOR >> 7;
  d_ = static_cast<uint16_t>(d > MAX_D ? MAX_D : d);
  if (i_ == 0) integral_ = 0;
}

OUT_OF_LINE void Pid::reset() {
  integral_ = 0;
  has_measured_ = false;
  change_q4_ = 0;
}

OUT_OF_LINE int32_t Pid::update(int16_t error, int16_t measured, int32_t limit) {
  int32_t output = scaled(p_, error);
  if (d_ != 0) output += derivative(measured);
  if (i_ == 0) return clamped(output, limit);
  const int32_t integral =
      clamped(integral_ + (scaled(i_, error) >> 3), limit << INTEGRAL_BITS);
  const int32_t sum = output + (integral >> INTEGRAL_BITS);
  const int32_t limited = clamped(sum, limit);
  // Output beyond the limit is not integrated any further.
  if (limited == sum || (limited < sum) != (error > 0)) integral_ = integral;
  return limited;
}

int32_t Pid::derivative(int16_t measured) {
  const uint16_t difference = static_cast<uint16_t>(measured) - static_cast<uint16_t>(measured_);
  const int16_t change = static_cast<int16_t>(difference);
  const bool is_change = has_measured_ && clamped16(change, MAX_CHANGE) == change;
  has_measured_ = true;
  measured_ = measured;
  const int16_t step_q4 = static_cast<int16_t>((is_change ? change : 0) * 16 - change_q4_);
  change_q4_ = static_cast<int16_t>(change_q4_ + step_q4 / 4);
  return clamped(scaled(d_, change_q4_), MAX_SLOPE) * -2;
}

}  // namespace raspilot
