/** `t` `g` `G`: the gains, of two axes as in the thesis or of three; kept when disarmed. */
#include "../../core/autopilot.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

Reason take_over(Autopilot& autopilot, bool is_in_range) {
  if (!is_in_range) return Reason::OUT_OF_RANGE;
  autopilot.controller.on_gains();
  // In flight they live in RAM.
  if (!autopilot.authority.is_armed()) autopilot.settings.save_gains();
  return Reason::NONE;
}

Reason on_two_axes(Autopilot& autopilot, const Request& request) {
  return take_over(autopilot, read_two_axes(request.payload, autopilot.settings.gains));
}

Reason on_three_axes(Autopilot& autopilot, const Request& request) {
  return take_over(autopilot, read_three_axes(request.payload, autopilot.settings.gains));
}

Reason on_three_axes_asked(Autopilot& autopilot, const Request&) {
  uint8_t payload[GAINS_SIZE];
  write_three_axes(autopilot.settings.gains, payload);
  autopilot.link.send('G', payload, sizeof payload);
  return Reason::NONE;
}

const CommandDefinition COMMANDS[] PROGMEM = {
    {'t', TWO_AXIS_GAINS_SIZE, Answer::CONFIRMED, on_two_axes},
    {'g', GAINS_SIZE, Answer::CONFIRMED, on_three_axes},
    {'G', 0, Answer::OWN, on_three_axes_asked},
};
CommandGroup group(COMMANDS);

}  // namespace
}  // namespace raspilot
