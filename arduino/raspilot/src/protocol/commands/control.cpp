/** `u`, `S`, `R`: the Raspberry Pi flies, by servo positions or by an attitude demand. */
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

bool read_setpoint(const Request& request, SetpointFields& fields) {
  if (!are_in_range(SETPOINT_FIELDS, COUNT, request.payload)) return false;
  read_fields(SETPOINT_FIELDS, COUNT, request.payload, &fields);
  return true;
}

Reason on_setpoint(Autopilot& autopilot, const Request& request) {
  SetpointFields fields;
  if (!read_setpoint(request, fields)) return Reason::OUT_OF_RANGE;
  return autopilot.authority.accept_setpoint(fields.setpoint, fields.lifetime_ms, request.now_us);
}

Reason on_return(Autopilot& autopilot, const Request& request) {
  SetpointFields fields;
  if (!read_setpoint(request, fields)) return Reason::OUT_OF_RANGE;
  return autopilot.authority.accept_return(fields.setpoint, fields.lifetime_ms, request.now_us);
}

const CommandDefinition COMMANDS[] PROGMEM = {
    {'u', 10, Answer::UNANSWERED, on_output},
    {'S', 10, Answer::UNANSWERED, on_setpoint},
    {'R', 10, Answer::UNANSWERED, on_return},
};
CommandGroup group(COMMANDS);

}  // namespace
}  // namespace raspilot
