#include "fields.h"

#include <string.h>

#include "../core/flash.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

struct Range {
  int16_t least;
  int16_t most;
};

/** In the order of Field. */
const Range RANGES[] PROGMEM = {{0, 1},    {0, 2},    {0, 255},       {-200, 200}, {800, 2200},
                                {0, 2200}, {0, 9000}, {-9000, 9000}, {-640, 640}, {-3000, 3000},
                                {-18000, 18000}, {-32768, 32767}, {1000, 2000}, {1000, 2000},
                                {1, 250}};

bool is_wide(uint8_t field) { return field >= TRIM; }

/** Where the next field of a struct lies, as the compiler aligns it. */
uint8_t* aligned(uint8_t* next) {
  const uintptr_t rest = reinterpret_cast<uintptr_t>(next) % alignof(int16_t);
  return rest == 0 ? next : next + alignof(int16_t) - rest;
}

}  // namespace

bool are_in_range(const uint8_t* fields, uint8_t count, const uint8_t* wire) {
  WireReader reader(wire);
  for (uint8_t at = 0; at < count; ++at) {
    const uint8_t field = pgm_read_byte(fields + at);
    // Words of 32768 and more become negative and are below every range that is for pulses.
    const int16_t value = is_wide(field) ? reader.i16() : reader.u8();
    if (field == STICK_OR_0 && value == 0) continue;
    if (value < static_cast<int16_t>(pgm_read_word(&RANGES[field].least))) return false;
    if (value > static_cast<int16_t>(pgm_read_word(&RANGES[field].most))) return false;
  }
  return true;
}

void read_fields(const uint8_t* fields, uint8_t count, const uint8_t* wire, void* object) {
  WireReader reader(wire);
  uint8_t* next = static_cast<uint8_t*>(object);
  for (uint8_t at = 0; at < count; ++at) {
    if (is_wide(pgm_read_byte(fields + at))) {
      next = aligned(next);
      const int16_t value = reader.i16();
      memcpy(next, &value, sizeof value);
      next += sizeof value;
    } else {
      *next++ = reader.u8();
    }
  }
}

void write_fields(const uint8_t* fields, uint8_t count, const void* object, uint8_t* wire) {
  WireWriter writer(wire);
  uint8_t* next = static_cast<uint8_t*>(const_cast<void*>(object));
  for (uint8_t at = 0; at < count; ++at) {
    if (is_wide(pgm_read_byte(fields + at))) {
      next = aligned(next);
      int16_t value;
      memcpy(&value, next, sizeof value);
      writer.i16(value);
      next += sizeof value;
    } else {
      writer.u8(*next++);
    }
  }
}

}  // namespace raspilot
