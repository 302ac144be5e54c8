#include "profile.h"

#include "../core/flash.h"
#include "fields.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

/** In the order of docs/protocols.md 2.6 and of Profile. */
const uint8_t FIELDS[] PROGMEM = {
    FLAG,   TRIM,   PULSE,  PULSE,                       // ailerons
    FLAG,   TRIM,   PULSE,  PULSE,                       // elevator
    FLAG,   TRIM,   PULSE,  PULSE,                       // throttle
    FLAG,   TRIM,   PULSE,  PULSE,                       // rudder
    MIX,    FLAG,   LETTER, LETTER, LETTER,              // mix, motor, switch
    LIMIT,  LIMIT,  LIMIT,  ANGLE,  ANGLE,               // limits, glide pitch, circle bank
    PULSE,  FLOOR,  PULSE,  PULSE,  PULSE,  LETTER       // throttle, presets, flags
};
constexpr uint8_t SERVO_SIZE = 7;
constexpr uint8_t LOWEST_AT = 3;
constexpr uint8_t SWITCH_AT = 30;

bool is_switch_mode(uint8_t letter) {
  return letter == 'a' || letter == 'r' || letter == 'f' || letter == 'A';
}

bool is_profile(const uint8_t* wire) {
  if (!are_in_range(FIELDS, sizeof FIELDS, wire)) return false;
  for (uint8_t output = 0; output < OUTPUTS; ++output) {
    WireReader reader(wire + output * SERVO_SIZE + LOWEST_AT);
    const uint16_t lowest_us = reader.u16();
    if (lowest_us >= reader.u16()) return false;
  }
  for (uint8_t position = 0; position < 3; ++position) {
    if (!is_switch_mode(wire[SWITCH_AT + position])) return false;
  }
  return true;
}

}  // namespace

const Profile DEFAULT_PROFILE PROGMEM = {
    {{false, 0, 1000, 2000}, {false, 0, 1000, 2000}, {false, 0, 1000, 2000}, {false, 0, 1000, 2000}},
    Mix::NONE,
    true,             // has_motor
    {'a', 'f', 'A'},  // AUX1 low, middle, high
    5000,             // FBW: roll, pitch up, pitch down, hundredths of a degree
    2000,
    2500,
    -300,  // receiver lost: pitch and bank of the circle, throttle output
    2000,
    1000,
    900,   // a throttle below this is the receiver's own failsafe
    1500,  // receiver lost and no attitude: ailerons, elevator, rudder
    1500,
    1500,
    0,  // flags
};

bool read_profile(const uint8_t* wire, Profile& profile) {
  if (!is_profile(wire)) return false;
  read_fields(FIELDS, sizeof FIELDS, wire, &profile);
  return true;
}

void write_profile(const Profile& profile, uint8_t* wire) {
  write_fields(FIELDS, sizeof FIELDS, &profile, wire);
}

}  // namespace raspilot
