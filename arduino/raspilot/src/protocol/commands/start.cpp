/** `s`: forwarding begins. Stabilising never waits for it. `p`: how often (thesis 3.2.5). */
#include "../../core/autopilot.h"
#include "../../store/wire_bytes.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

constexpr int16_t MIN_DELAY_MS = 10;
constexpr int16_t MAX_DELAY_MS = 1000;

Reason on_start(Autopilot& autopilot, const Request& request) {
  autopilot.link.start(request.now_us);
  return Reason::NONE;
}

Reason on_panic(Autopilot& autopilot, const Request& request) {
  const int16_t delay_ms = WireReader(request.payload + 1).i16();
  if (request.payload[0] > 1 || delay_ms < MIN_DELAY_MS || delay_ms > MAX_DELAY_MS) {
    return Reason::OUT_OF_RANGE;
  }
  autopilot.link.set_period_ms(static_cast<uint16_t>(delay_ms));
  return Reason::NONE;
}

const CommandDefinition COMMANDS[] REGISTERED = {
    {'s', 0, Answer::CONFIRMED, on_start},
    {'p', 3, Answer::CONFIRMED, on_panic},
};

}  // namespace
}  // namespace raspilot
