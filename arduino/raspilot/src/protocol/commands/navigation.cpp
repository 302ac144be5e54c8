/**
 * `h` `b` `B` `l`: altitude, headings, location. They are checked and then unused: the Raspberry Pi
 * navigates, an old one sends them all the same.
 */
#include "../../store/wire_bytes.h"
#include "../command_executor.h"
#include "../location.h"

namespace raspilot {
namespace {

Reason on_altitude(Autopilot&, const Request&) { return Reason::NONE; }

Reason on_heading(Autopilot&, const Request& request) {
  const int16_t heading_deg = WireReader(request.payload).i16();
  return heading_deg >= 0 && heading_deg <= 359 ? Reason::NONE : Reason::OUT_OF_RANGE;
}

Reason on_location(Autopilot&, const Request& request) {
  WireReader reader(request.payload);
  const bool is_latitude = is_magnitude_within(reader.u32(), MOST_LATITUDE);
  const bool is_longitude = is_magnitude_within(reader.u32(), MOST_LONGITUDE);
  return is_latitude && is_longitude ? Reason::NONE : Reason::OUT_OF_RANGE;
}

const CommandDefinition COMMANDS[] PROGMEM = {
    {'h', 2, Framing::BOTH, Answer::UNANSWERED, on_altitude},
    {'b', 2, Framing::BOTH, Answer::UNANSWERED, on_heading},
    {'B', 2, Framing::BOTH, Answer::UNANSWERED, on_heading},
    {'l', 8, Framing::BOTH, Answer::UNANSWERED, on_location},
};
CommandGroup group(COMMANDS);

}  // namespace
}  // namespace raspilot
