#include "gains.h"

#include <string.h>

#include "../core/flash.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

constexpr uint8_t AXES = 3;
constexpr uint8_t WIRED_AXES = 2;
/** Positive floats are ordered as their bits are, and infinity and NaN lie above every number. */
constexpr uint32_t GREATEST_GAIN_BITS = 0x42480000;
constexpr uint32_t MINUS_ZERO_BITS = 0x80000000;

void read_axes(WireReader& reader, PidGains* axes, uint8_t count) {
  for (uint8_t axis = 0; axis < count; ++axis) {
    axes[axis].p = reader.f32();
    axes[axis].i = reader.f32();
    axes[axis].d = reader.f32();
  }
}

void write_axes(WireWriter& writer, const PidGains* axes, uint8_t count) {
  for (uint8_t axis = 0; axis < count; ++axis) {
    writer.f32(axes[axis].p);
    writer.f32(axes[axis].i);
    writer.f32(axes[axis].d);
  }
}

bool read_axes_of_both(const uint8_t* wire, Gains& gains, uint8_t count) {
  Gains staged = gains;
  WireReader reader(wire);
  read_axes(reader, staged.rate, count);
  read_axes(reader, staged.stabilize, count);
  if (!is_in_range(staged)) return false;
  gains = staged;
  return true;
}

void write_axes_of_both(const Gains& gains, uint8_t* wire, uint8_t count) {
  WireWriter writer(wire);
  write_axes(writer, gains.rate, count);
  write_axes(writer, gains.stabilize, count);
}

bool is_gain(float gain) {
  uint32_t bits;
  memcpy(&bits, &gain, sizeof bits);
  return bits <= GREATEST_GAIN_BITS || bits == MINUS_ZERO_BITS;
}

bool are_gains(const PidGains* axes) {
  for (uint8_t axis = 0; axis < AXES; ++axis) {
    if (!is_gain(axes[axis].p) || !is_gain(axes[axis].i) || !is_gain(axes[axis].d)) return false;
  }
  return true;
}

}  // namespace

const Gains DEFAULT_GAINS PROGMEM = {
    {{6.0f, 0.0f, 0.0f}, {3.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}},
    {{8.0f, 0.0f, 0.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}},
};

bool is_in_range(const Gains& gains) { return are_gains(gains.rate) && are_gains(gains.stabilize); }

bool read_three_axes(const uint8_t* wire, Gains& gains) {
  return read_axes_of_both(wire, gains, AXES);
}

bool read_two_axes(const uint8_t* wire, Gains& gains) {
  return read_axes_of_both(wire, gains, WIRED_AXES);
}

void write_three_axes(const Gains& gains, uint8_t* wire) { write_axes_of_both(gains, wire, AXES); }

void write_two_axes(const Gains& gains, uint8_t* wire) {
  write_axes_of_both(gains, wire, WIRED_AXES);
}

}  // namespace raspilot
