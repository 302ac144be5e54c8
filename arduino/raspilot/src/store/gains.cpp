#include "gains.h"

#include "../core/compiler.h"
#include "../core/flash.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

static_assert(sizeof(Gains) == GAINS_SIZE && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "the wire has a gain's bytes in the opposite order");

constexpr uint8_t GAINS = 18;
/** Upper halves of 50.0f and -0.0f; infinity and NaN lie above every positive number. */
constexpr uint16_t MAX_GAIN_UPPER = 0x4248;
constexpr uint16_t MINUS_ZERO_UPPER = 0x8000;

uint8_t opposite(uint8_t at) { return at ^ 3; }

}  // namespace

const Gains DEFAULT_GAINS PROGMEM = {
    {{2.0f, 0.0f, 0.0f}, {1.5f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}},
    {{8.0f, 0.0f, 0.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}},
};

bool read_gains(const uint8_t* wire, Gains& gains) {
  WireReader reader(wire);
  for (uint8_t count = 0; count < GAINS; ++count) {
    const uint16_t upper = reader.u16();
    const uint16_t lower = reader.u16();
    const bool is_edge = upper == MAX_GAIN_UPPER || upper == MINUS_ZERO_UPPER;
    if (upper >= MAX_GAIN_UPPER && !(is_edge && lower == 0)) return false;
  }
  uint8_t* const bytes = reinterpret_cast<uint8_t*>(&gains);
  for (uint8_t at = 0; at < GAINS_SIZE; ++at) bytes[opposite(at)] = wire[at];
  return true;
}

OUT_OF_LINE void write_gains(const Gains& gains, uint8_t* wire) {
  const uint8_t* const bytes = reinterpret_cast<const uint8_t*>(&gains);
  for (uint8_t at = 0; at < GAINS_SIZE; ++at) wire[at] = bytes[opposite(at)];
}

}  // namespace raspilot
