/** `u` and `S`: the Raspberry Pi flies, by servo positions or by an attitude demand. */
#include "../../core/autopilot.h"
#include "../../store/wire_bytes.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

constexpr int16_t MAX_ROLL_CDEG = 18000;
constexpr int16_t MAX_PITCH_CDEG = 9000;
constexpr uint16_t MAX_LIFETIME_MS = 250;

bool is_pulse(uint16_t pulse_us) { return pulse_us >= 1000 && pulse_us <= 2000; }

/** 0 leaves the throttle to the stick. */
bool is_throttle(uint16_t pulse_us) { return pulse_us == 0 || is_pulse(pulse_us); }

bool is_within(int16_t value, int16_t most) { return value >= -most && value <= most; }

Reason on_output(Autopilot& autopilot, const Request& request) {
  uint16_t pulses_us[OUTPUTS];
  WireReader reader(request.payload);
  for (uint8_t output = 0; output < OUTPUTS; ++output) {
    pulses_us[output] = reader.u16();
    if (!(output == THROTTLE ? is_throttle(pulses_us[output]) : is_pulse(pulses_us[output]))) {
      return Reason::OUT_OF_RANGE;
    }
  }
  const uint32_t age_us = autopilot.link.orientation_age_us(reader.u16(), request.now_us);
  return autopilot.authority.accept_outputs(pulses_us, age_us, request.now_us);
}

Reason on_setpoint(Autopilot& autopilot, const Request& request) {
  WireReader reader(request.payload);
  Setpoint setpoint;
  setpoint.roll_cdeg = reader.i16();
  setpoint.pitch_cdeg = reader.i16();
  setpoint.yaw_rate_cdeg_s = reader.i16();
  setpoint.throttle_us = reader.u16();
  const uint16_t lifetime_ms = reader.u16();
  if (!is_within(setpoint.roll_cdeg, MAX_ROLL_CDEG) ||
      !is_within(setpoint.pitch_cdeg, MAX_PITCH_CDEG) || !is_throttle(setpoint.throttle_us) ||
      lifetime_ms == 0 || lifetime_ms > MAX_LIFETIME_MS) {
    return Reason::OUT_OF_RANGE;
  }
  return autopilot.authority.accept_setpoint(setpoint, lifetime_ms, request.now_us);
}

const CommandDefinition COMMANDS[] PROGMEM = {
    {'u', 10, Framing::CHECKED, Answer::UNANSWERED, on_output},
    {'S', 10, Framing::CHECKED, Answer::UNANSWERED, on_setpoint},
};
CommandGroup group(COMMANDS);

}  // namespace
}  // namespace raspilot
