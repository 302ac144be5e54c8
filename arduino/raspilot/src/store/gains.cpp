#include "gains.h"

#include <string.h>

#include "../core/flash.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

static_assert(sizeof(Gains) == GAINS_SIZE, "the copies below count on it");

constexpr uint8_t GAINS = 18;
constexpr uint8_t GAINS_A_LOOP = 9;
constexpr uint8_t WIRED_GAINS_A_LOOP = 6;
/** 50.0f. Positive floats are ordered as their bits are, and infinity and NaN lie above every number. */
constexpr uint32_t MAX_GAIN_BITS = 0x42480000;
constexpr uint32_t MINUS_ZERO_BITS = 0x80000000;

bool read(const uint8_t* wire, Gains& gains, uint8_t gains_a_loop) {
  WireReader judged(wire);
  for (uint8_t count = 0; count < 2 * gains_a_loop; ++count) {
    if (!is_gain(judged.u32())) return false;
  }
  WireReader reader(wire);
  uint8_t* next = reinterpret_cast<uint8_t*>(&gains);
  for (uint8_t loop = 0; loop < 2; ++loop) {
    for (uint8_t count = 0; count < gains_a_loop; ++count) {
      const uint32_t bits = reader.u32();
      memcpy(next + count * sizeof bits, &bits, sizeof bits);
    }
    next += GAINS_A_LOOP * sizeof(float);
  }
  return true;
}

}  // namespace

bool is_gain(uint32_t bits) { return bits <= MAX_GAIN_BITS || bits == MINUS_ZERO_BITS; }

const Gains DEFAULT_GAINS PROGMEM = {
    {{2.0f, 0.0f, 0.0f}, {1.5f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}},
    {{8.0f, 0.0f, 0.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}},
};

bool read_three_axes(const uint8_t* wire, Gains& gains) { return read(wire, gains, GAINS_A_LOOP); }

bool read_two_axes(const uint8_t* wire, Gains& gains) {
  return read(wire, gains, WIRED_GAINS_A_LOOP);
}

void write_three_axes(const Gains& gains, uint8_t* wire) {
  WireWriter writer(wire);
  const uint8_t* next = reinterpret_cast<const uint8_t*>(&gains);
  for (uint8_t count = 0; count < GAINS; ++count) {
    uint32_t bits;
    memcpy(&bits, next, sizeof bits);
    writer.u32(bits);
    next += sizeof bits;
  }
}

}  // namespace raspilot
