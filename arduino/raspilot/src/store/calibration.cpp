#include "calibration.h"

#include "../core/flash.h"
#include "fields.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

/** In the order of Calibration. */
const uint8_t FIELDS[] PROGMEM = {
    BIAS,  BIAS,  BIAS,  LEVEL, LEVEL,                                          // gyro, mounting
    PULSE, PULSE, PULSE, PULSE, PULSE, PULSE, PULSE, PULSE, PULSE,             // three channels
    PULSE, PULSE, PULSE, PULSE, PULSE, PULSE, PULSE, PULSE, PULSE              // three channels
};
constexpr uint8_t RANGES_AT = 10;

}  // namespace

const Calibration DEFAULT_CALIBRATION PROGMEM = {
    {0, 0, 0},
    0,
    0,
    {{1000, 1500, 2000},
     {1000, 1500, 2000},
     {1000, 1500, 2000},
     {1000, 1500, 2000},
     {1000, 1500, 2000},
     {1000, 1500, 2000}},
};

bool read_calibration(const uint8_t* bytes, Calibration& calibration) {
  if (!are_in_range(FIELDS, sizeof FIELDS, bytes)) return false;
  WireReader reader(bytes + RANGES_AT);
  for (uint8_t channel = 0; channel < INPUTS; ++channel) {
    const uint16_t lowest_us = reader.u16();
    const uint16_t centre_us = reader.u16();
    const uint16_t highest_us = reader.u16();
    if (centre_us < lowest_us + MIN_HALF_RANGE_US) return false;
    if (highest_us < centre_us + MIN_HALF_RANGE_US) return false;
  }
  read_fields(FIELDS, sizeof FIELDS, bytes, &calibration);
  return true;
}

void write_calibration(const Calibration& calibration, uint8_t* bytes) {
  write_fields(FIELDS, sizeof FIELDS, &calibration, bytes);
}

}  // namespace raspilot
