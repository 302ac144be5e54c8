/**
 * `h` `b` `B` `l`: altitude, headings, location. They are checked and then unused: the Raspberry Pi
 * navigates, an old one sends them all the same.
 */
#include "../../store/wire_bytes.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

constexpr float MOST_LATITUDE_DEG = 90.0f;
constexpr float MOST_LONGITUDE_DEG = 180.0f;

/** False for NaN too. */
bool is_within(float value, float most) { return value >= -most && value <= most; }

Reason on_altitude(Autopilot&, const Request&) { return Reason::NONE; }

Reason on_heading(Autopilot&, const Request& request) {
  const int16_t heading_deg = WireReader(request.payload).i16();
  return heading_deg >= 0 && heading_deg <= 359 ? Reason::NONE : Reason::OUT_OF_RANGE;
}

Reason on_location(Autopilot&, const Request& request) {
  WireReader reader(request.payload);
  const bool is_latitude = is_within(reader.f32(), MOST_LATITUDE_DEG);
  const bool is_longitude = is_within(reader.f32(), MOST_LONGITUDE_DEG);
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
