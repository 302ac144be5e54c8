/** The RC receiver's six wires, and the stamps that the chip's interrupt would make of them. */
#include <algorithm>
#include <vector>

#include "chip/edges.h"
#include "hardware.h"

namespace host {
namespace receiver {

namespace {

using raspilot::INPUTS;

constexpr Cycles PERIOD = 20000 * PER_US;
constexpr Cycles GAP = 10 * PER_US;
/** From the edge to the stamp. */
constexpr Cycles INTERRUPT = 22;
/** The chip's ring, in which one place stays empty. */
constexpr size_t STAMPS = 17;

struct Edge {
  Cycles at;
  uint8_t channel;
  bool is_high;
};
struct Stamp {
  uint16_t ticks;
  uint8_t levels;
};

double widths_us[INPUTS] = {1500, 1500, 1000, 1500, 1000, 1000};
uint8_t silent;
Cycles next_frame = NEVER;
/** By time, the next one last. */
std::vector<Edge> edges;
std::vector<Stamp> stamps;
uint8_t levels;
bool is_listening;
bool is_lost;

void add(Cycles at, uint8_t channel, bool is_high) {
  const auto place = std::find_if(edges.begin(), edges.end(),
                                  [at](const Edge& edge) { return edge.at <= at; });
  edges.insert(place, Edge{at, channel, is_high});
}

void send_frame(Cycles at) {
  for (uint8_t channel = 0; channel < INPUTS; ++channel) {
    const Cycles width = static_cast<Cycles>(widths_us[channel] * PER_US + 0.5);
    if (!(silent >> channel & 1)) {
      add(at, channel, true);
      add(at + std::max<Cycles>(width, 2), channel, false);
    }
    at += width + GAP;
  }
}

void take(const Edge& edge) {
  const uint8_t bit = static_cast<uint8_t>(1 << edge.channel);
  const uint8_t after = static_cast<uint8_t>(edge.is_high ? levels | bit : levels & ~bit);
  if (after == levels) return;
  levels = after;
  if (!is_listening || is_lost) return;
  is_lost = stamps.size() == STAMPS;
  if (is_lost) return;
  stamps.push_back(Stamp{static_cast<uint16_t>(timer::ticks_at(edge.at + INTERRUPT)), levels});
}

}  // namespace

void begin(Cycles first_frame) { next_frame = first_frame; }

void set(uint8_t channel, double width_us) { widths_us[channel] = width_us; }

void set_on(bool is_on) {
  silent = is_on ? 0 : raspilot::ALL_INPUTS;
}

void set_channel(uint8_t channel, bool is_on) {
  const uint8_t bit = static_cast<uint8_t>(1 << channel);
  silent = static_cast<uint8_t>(is_on ? silent & ~bit : silent | bit);
}

void run(Cycles moment) {
  for (; next_frame <= moment; next_frame += PERIOD) send_frame(next_frame);
  while (!edges.empty() && edges.back().at <= moment) {
    take(edges.back());
    edges.pop_back();
  }
}

void reset() { is_listening = false; }

}  // namespace receiver
}  // namespace host

namespace raspilot {
namespace edges {

void begin() {
  host::receiver::stamps.clear();
  host::receiver::is_lost = false;
  host::receiver::is_listening = true;
}

void drain(PwmReader& reader, uint32_t now_us) {
  using namespace host::receiver;
  for (const Stamp& stamp : stamps) reader.on_edge(stamp.ticks, stamp.levels, false, now_us);
  stamps.clear();
  if (is_lost) reader.on_lost_edges();
  is_lost = false;
}

}  // namespace edges
}  // namespace raspilot
