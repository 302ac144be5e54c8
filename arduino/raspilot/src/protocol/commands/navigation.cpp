/**
 * `h` `b` `B` `l`: altitude, headings, location. The Raspberry Pi navigates: nothing here uses them.
 * In thesis framing they are dropped, because an old Raspberry Pi sends them all the same.
 */
#include "../../core/autopilot.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

Reason on_navigation(Autopilot& autopilot, const Request&) {
  return autopilot.link.is_thesis() ? Reason::NONE : Reason::NOT_SUPPORTED;
}

const CommandDefinition COMMANDS[] PROGMEM = {
    {'h', 2, Framing::BOTH, Answer::UNANSWERED, on_navigation},
    {'b', 2, Framing::BOTH, Answer::UNANSWERED, on_navigation},
    {'B', 2, Framing::BOTH, Answer::UNANSWERED, on_navigation},
    {'l', 8, Framing::BOTH, Answer::UNANSWERED, on_navigation},
};
CommandGroup group(COMMANDS);

}  // namespace
}  // namespace raspilot
