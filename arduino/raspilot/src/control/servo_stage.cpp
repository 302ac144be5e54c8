#include "servo_stage.h"

#include "fixed_point.h"

namespace raspilot {

namespace {

constexpr Ticks NEUTRAL = us_to_ticks(1500);
constexpr Ticks MOTOR_OFF = us_to_ticks(1000);
// No sum of two demands and a trim leaves 16 bits.
constexpr int32_t GREATEST_DEFLECTION = 8000;

Ticks within(const ServoSetup& servo, int32_t ticks) {
  const int32_t lowest = static_cast<int32_t>(servo.lowest_us) * 2;
  const int32_t highest = static_cast<int32_t>(servo.highest_us) * 2;
  return static_cast<Ticks>(ticks < lowest ? lowest : ticks > highest ? highest : ticks);
}

Ticks to_pulse(const ServoSetup& servo, int32_t deflection) {
  const int32_t moved = clamped(deflection, GREATEST_DEFLECTION);
  const int32_t turned = servo.is_reversed ? -moved : moved;
  return within(servo, turned + NEUTRAL + static_cast<int32_t>(servo.trim_us) * 2);
}

}  // namespace

void to_servos(const Profile& profile, const Ticks* demands, Outputs& outputs) {
  int32_t deflections[OUTPUTS];
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    deflections[channel] = static_cast<int32_t>(demands[channel]) - NEUTRAL;
  }
  const int32_t elevator = deflections[ELEVATOR];
  if (profile.mix == Mix::ELEVON) {
    deflections[ELEVATOR] = elevator - deflections[AILERONS];
    deflections[AILERONS] = elevator + deflections[AILERONS];
  } else if (profile.mix == Mix::V_TAIL) {
    deflections[ELEVATOR] = elevator + deflections[RUDDER];
    deflections[RUDDER] = elevator - deflections[RUDDER];
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
