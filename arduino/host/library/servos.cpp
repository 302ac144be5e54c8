/** The timers' compare outputs: each pulse rises and falls at its tick, as wide as was set then. */
#include "chip/servo_edges.h"
#include "hardware.h"

namespace host {
namespace servos {

namespace {

using raspilot::OUTPUTS;

/** From the slot's beginning to the pulses: receiver, authority, attitude, control. */
constexpr Cycles CONTROL = 780 * PER_US;

struct Output {
  uint16_t width_ticks;
  Cycles rise;
  Cycles fall;
  bool is_busy;
};

Output outputs[OUTPUTS];
void end(uint8_t channel) {
  Output& output = outputs[channel];
  output.is_busy = false;
  view.width_us[channel] = to_us(output.fall - output.rise);
  view.ended_us[channel] = to_us(output.fall);
}

}  // namespace

void run(Cycles moment) {
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    Output& output = outputs[channel];
    if (!output.is_busy || output.rise > moment) continue;
    if (output.fall == NEVER) output.fall = output.rise + output.width_ticks * (PER_US / 2);
    if (output.fall <= moment) end(channel);
  }
}

/** A chip in reset drives nothing: a pulse under way is cut. */
void reset(Cycles moment) {
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    Output& output = outputs[channel];
    if (!output.is_busy) continue;
    const bool has_risen = output.fall != NEVER;
    output.fall = moment;
    output.is_busy = false;
    if (has_risen) end(channel);
  }
}

}  // namespace servos
}  // namespace host

namespace raspilot {
namespace servo_edges {

using namespace host::servos;

void begin() {
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    const uint16_t width = us_to_ticks(channel == THROTTLE ? 1000 : 1500);
    outputs[channel] = Output{width, 0, host::NEVER, false};
  }
}

bool is_busy(Channel channel) { return outputs[channel].is_busy; }

void plan(Channel channel, uint16_t rise_ticks) {
  const int64_t now = host::timer::ticks_at(host::now());
  const int16_t ahead = static_cast<int16_t>(rise_ticks - static_cast<uint16_t>(now));
  outputs[channel].rise = host::timer::cycles_at(now + ahead);
  outputs[channel].fall = host::NEVER;
  outputs[channel].is_busy = true;
}

void set_width(Channel channel, Ticks width) {
  // The first of the four rises when control has ended.
  if (channel == AILERONS) host::pass(CONTROL);
  outputs[channel].width_ticks = static_cast<uint16_t>(width);
}

}  // namespace servo_edges
}  // namespace raspilot
