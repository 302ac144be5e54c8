/** The results of calibration, kept in EEPROM beside profile and gains. */
#pragma once

#include <stdint.h>

#include "../core/types.h"

namespace raspilot {

/** One receiver channel's end points and centre as this maker sends them (thesis 2.4.1), us. */
struct ChannelRange {
  uint16_t lowest_us;
  uint16_t centre_us;
  uint16_t highest_us;
};

/** Gyro bias in sixteenths of a deg/s, level offsets in hundredths of a degree, receiver ranges. */
struct Calibration {
  int16_t gyro_bias_16[3];
  int16_t level_roll_cdeg;
  int16_t level_pitch_cdeg;
  ChannelRange receiver[INPUTS];
};

constexpr uint8_t CALIBRATION_SIZE = 46;

/** From the centre to either end at least, so that scaling stays sane. */
constexpr uint16_t MIN_HALF_RANGE_US = 100;

/** No bias, level as mounted, every channel 1000, 1500, 2000 us. In flash: copy with memcpy_P. */
extern const Calibration DEFAULT_CALIBRATION;

/** Reads the 46 bytes that EEPROM keeps. False and untouched when a value is out of range. */
bool read_calibration(const uint8_t* bytes, Calibration& calibration);
void write_calibration(const Calibration& calibration, uint8_t* bytes);

}  // namespace raspilot
