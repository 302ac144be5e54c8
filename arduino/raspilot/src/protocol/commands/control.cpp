/** `u` and `S`: the Raspberry Pi flies, by servo positions or by an attitude demand. */
#include "../../core/autopilot.h"
#include "../../store/fields.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

struct OutputFields {
  uint16_t pulses_us[OUTPUTS];
  uint16_t sequence;
};

struct SetpointFields {
  Setpoint setpoint;
  uint16_t lifetime_ms;
};

const uint8_t OUTPUT_FIELDS[] PROGMEM = {STICK, STICK, STICK_OR_0, STICK, WORD};
const uint8_t SETPOINT_FIELDS[] PROGMEM = {BANK, ANGLE, WORD, STICK_OR_0, LIFETIME};
constexpr uint8_t COUNT = sizeof SETPOINT_FIELDS;
static_assert(sizeof OUTPUT_FIELDS == COUNT, "one count for both");

Reason on_output(Autopilot& autopilot, const Request& request) {
  if (!are_in_range(OUTPUT_FIELDS, COUNT, request.payload)) return Reason::OUT_OF_RANGE;
  OutputFields fields;
  read_fields(OUTPUT_FIELDS, COUNT, request.payload, &fields);
  const uint32_t age_us = autopilot.link.orientation_age_us(fields.sequence, request.now_us);
  return autopilot.authority.accept_outputs(fields.pulses_us, age_us, request.now_us);
}

Reason on_setpoint(Autopilot& autopilot, const Request& request) {
  if (!are_in_range(SETPOINT_FIELDS, COUNT, request.payload)) return Reason::OUT_OF_RANGE;
  SetpointFields fields;
  read_fields(SETPOINT_FIELDS, COUNT, request.payload, &fields);
  return autopilot.authority.accept_setpoint(fields.setpoint, fields.lifetime_ms, request.now_us);
}

const CommandDefinition COMMANDS[] PROGMEM = {
    {'u', 10, Framing::CHECKED, Answer::UNANSWERED, on_output},
    {'S', 10, Framing::CHECKED, Answer::UNANSWERED, on_setpoint},
};
CommandGroup group(COMMANDS);

}  // namespace
}  // namespace raspilot
