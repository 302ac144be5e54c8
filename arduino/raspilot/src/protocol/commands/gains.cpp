/** `g` `G`: the gains; kept when disarmed. */
#include "../../core/autopilot.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

Reason on_gains(Autopilot& autopilot, const Request& request) {
  if (!read_gains(request.payload, autopilot.settings.gains)) return Reason::OUT_OF_RANGE;
  autopilot.controller.on_gains();
  // In flight they live in RAM.
  if (!autopilot.authority.is_armed()) autopilot.settings.save_gains();
  return Reason::NONE;
}

Reason on_gains_asked(Autopilot& autopilot, const Request&) {
  uint8_t payload[GAINS_SIZE];
  write_gains(autopilot.settings.gains, payload);
  autopilot.link.send('G', payload, sizeof payload);
  return Reason::NONE;
}

const CommandDefinition COMMANDS[] REGISTERED = {
    {'g', GAINS_SIZE, Answer::CONFIRMED, on_gains},
    {'G', 0, Answer::OWN, on_gains_asked},
};

}  // namespace
}  // namespace raspilot
