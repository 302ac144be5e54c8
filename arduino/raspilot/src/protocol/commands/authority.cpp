/** `a` `d` `v` `M` `m`: arming, the Raspberry Pi's veto, the flight mode that it requests. */
#include "../../core/autopilot.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

Reason on_arm(Autopilot& autopilot, const Request&) {
  return autopilot.authority.arm();
}

Reason on_disarm(Autopilot& autopilot, const Request&) {
  return autopilot.authority.disarm();
}

Reason on_veto(Autopilot& autopilot, const Request& request) {
  if (request.payload[0] > 1) return Reason::OUT_OF_RANGE;
  autopilot.authority.accept_veto(request.payload[0] == 1);
  return Reason::NONE;
}

Reason on_mode(Autopilot& autopilot, const Request& request) {
  const char letter = static_cast<char>(request.payload[0]);
  if (letter != 'r' && letter != 'f' && letter != 's' && letter != 'u') {
    return Reason::OUT_OF_RANGE;
  }
  return autopilot.authority.request_mode(letter);
}

Reason on_mode_asked(Autopilot& autopilot, const Request&) {
  const uint8_t letter = static_cast<uint8_t>(autopilot.authority.mode());
  autopilot.link.send('m', &letter, 1);
  return Reason::NONE;
}

const CommandDefinition COMMANDS[] REGISTERED = {
    {'a', 0, Answer::CONFIRMED, on_arm},
    {'d', 0, Answer::CONFIRMED, on_disarm},
    {'v', 1, Answer::UNANSWERED, on_veto},
    {'M', 1, Answer::CONFIRMED, on_mode},
    {'m', 0, Answer::OWN, on_mode_asked},
};

}  // namespace
}  // namespace raspilot
