#include "servo_stage.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr Ticks NEUTRAL = us_to_ticks(1500);
constexpr Ticks MOTOR_OFF = us_to_ticks(1000);
// No demand exceeds this, and no sum of two and a trim leaves 16 bits.
constexpr int16_t MAX_DEFLECTION = 4000;

OUT_OF_LINE Ticks within(const ServoSetup& servo, Ticks ticks) {
  const Ticks lowest = us_to_ticks(static_cast<int16_t>(servo.lowest_us));
  const Ticks highest = us_to_ticks(static_cast<int16_t>(servo.highest_us));
  return ticks < lowest ? lowest : ticks > highest ? highest : ticks;
}

Ticks to_pulse(const ServoSetup& servo, int16_t deflection) {
  const int16_t turned = static_cast<int16_t>(servo.is_reversed ? -deflection : deflection);
  return within(servo, static_cast<Ticks>(turned + NEUTRAL + us_to_ticks(servo.trim_us)));
}

}  // namespace

OUT_OF_LINE void to_servos(const Profile& profile, const Ticks* demands, Outputs& outputs) {
  int16_t deflections[OUTPUTS];
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    deflections[channel] = clamped16(difference_of(demands[channel], NEUTRAL), MAX_DEFLECTION);
  }
  const int16_t ailerons = deflections[AILERONS];
  const int16_t elevator = deflections[ELEVATOR];
  const int16_t rudder = deflections[RUDDER];
  if (profile.mix == Mix::ELEVON) {
    deflections[AILERONS] = static_cast<int16_t>(elevator - ailerons);
    deflections[ELEVATOR] = static_cast<int16_t>(elevator + ailerons);
  } else if (profile.mix == Mix::V_TAIL) {
    deflections[ELEVATOR] = static_cast<int16_t>(elevator + rudder);
    deflections[RUDDER] = static_cast<int16_t>(elevator - rudder);
  }
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    outputs.ticks[channel] = to_pulse(profile.servos[channel], deflections[channel]);
  }
  if (!profile.has_motor) return;
  const Ticks throttle = demands[THROTTLE];
  outputs.ticks[THROTTLE] =
      throttle == MOTOR_OFF ? MOTOR_OFF : within(profile.servos[THROTTLE], throttle);
}

}  // namespace raspilot
