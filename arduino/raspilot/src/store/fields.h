/**
 * Converts structs of small numbers to wire bytes and back by a table, which takes a third of the
 * flash of one statement per field.
 *
 * A table lists the kind of each field in the order of struct and wire alike; both must have the
 * same order, and the struct holds only bool, char, one-byte enums and 16-bit integers.
 */
#pragma once

#include <stdint.h>

namespace raspilot {

/** Kinds of fields; 16 bits from TRIM on, big-endian on the wire. */
enum Field : uint8_t {
  FLAG,    ///< 0 or 1
  MIX,     ///< 0 to 2
  LETTER,  ///< a byte that the caller judges
  TRIM,    ///< -200 to 200 us
  PULSE,   ///< 800 to 2200 us
  FLOOR,   ///< 0 to 2200 us
  LIMIT,   ///< 0 to 9000 cdeg
  ANGLE,   ///< -9000 to 9000 cdeg
  BIAS,    ///< 40 deg/s in sixteenths: twice what the MPU6050's data sheet (6.1) allows
  LEVEL,   ///< -3000 to 3000 cdeg
  BANK,    ///< -18000 to 18000 cdeg
  WORD,    ///< any
  STICK,   ///< 1000 to 2000 us
  STICK_OR_0,
  LIFETIME  ///< 1 to 250 ms
};

/** Whether every field of the wire is in its range. `fields` lies in flash. */
bool are_in_range(const uint8_t* fields, uint8_t count, const uint8_t* wire);
/** Reads every field into the struct at `object`. */
void read_fields(const uint8_t* fields, uint8_t count, const uint8_t* wire, void* object);
/** Writes every field of the struct at `object`. */
void write_fields(const uint8_t* fields, uint8_t count, const void* object, uint8_t* wire);

}  // namespace raspilot
