/**
 * `u`, `S`, `R`: the Raspberry Pi flies, by servo positions or by an attitude demand. `A`: the
 * airspeed that it has measured, for the attitude.
 */
#include "../../core/autopilot.h"
#include "../../store/fields.h"
#include "../../store/wire_bytes.h"
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
constexpr int16_t MIN_AIRSPEED_CM_S = 500;
constexpr int16_t MAX_AIRSPEED_CM_S = 4000;
constexpr uint8_t COUNT = sizeof SETPOINT_FIELDS;
static_assert(sizeof OUTPUT_FIELDS == COUNT, "one count for both");

/** Reads the payload as these fields; false when one is out of range. */
OUT_OF_LINE bool read(const Request& request, const uint8_t* types, void* fields) {
  if (!are_in_range(types, COUNT, request.payload)) return false;
  read_fields(types, COUNT, request.payload, fields);
  return true;
}

Reason on_output(Autopilot& autopilot, const Request& request) {
  OutputFields fields;
  if (!read(request, OUTPUT_FIELDS, &fields)) return Reason::OUT_OF_RANGE;
  const uint32_t age_us = autopilot.link.orientation_age_us(fields.sequence, request.now_us);
  return autopilot.authority.accept_outputs(fields.pulses_us, age_us);
}

Reason on_setpoint(Autopilot& autopilot, const Request& request) {
  SetpointFields fields;
  if (!read(request, SETPOINT_FIELDS, &fields)) return Reason::OUT_OF_RANGE;
  return autopilot.authority.accept_setpoint(fields.setpoint, fields.lifetime_ms);
}

Reason on_return(Autopilot& autopilot, const Request& request) {
  SetpointFields fields;
  if (!read(request, SETPOINT_FIELDS, &fields)) return Reason::OUT_OF_RANGE;
  return autopilot.authority.accept_return(fields.setpoint, fields.lifetime_ms);
}

Reason on_airspeed(Autopilot& autopilot, const Request& request) {
  const int16_t cm_s = WireReader(request.payload).i16();
  if (cm_s < MIN_AIRSPEED_CM_S || cm_s > MAX_AIRSPEED_CM_S) return Reason::OUT_OF_RANGE;
  autopilot.attitude.take_airspeed(cm_s);
  return Reason::NONE;
}

const CommandDefinition COMMANDS[] REGISTERED = {
    {'u', 10, Answer::UNANSWERED, on_output},
    {'S', 10, Answer::UNANSWERED, on_setpoint},
    {'R', 10, Answer::UNANSWERED, on_return},
    {'A', 2, Answer::UNANSWERED, on_airspeed},
};

}  // namespace
}  // namespace raspilot
