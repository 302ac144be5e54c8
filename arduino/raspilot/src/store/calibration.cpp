#include "calibration.h"

#include "../core/flash.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

bool is_within(int16_t value, int16_t limit) { return value >= -limit && value <= limit; }

bool is_range(const ChannelRange& range) {
  return range.lowest_us >= LOWEST_END_US && range.highest_us <= HIGHEST_END_US &&
         range.centre_us >= range.lowest_us + LEAST_HALF_RANGE_US &&
         range.highest_us >= range.centre_us + LEAST_HALF_RANGE_US;
}

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

bool is_in_range(const Calibration& calibration) {
  for (uint8_t axis = 0; axis < 3; ++axis) {
    if (!is_within(calibration.gyro_bias_16[axis], GREATEST_BIAS_16)) return false;
  }
  for (uint8_t channel = 0; channel < INPUTS; ++channel) {
    if (!is_range(calibration.receiver[channel])) return false;
  }
  return is_within(calibration.level_roll_cdeg, GREATEST_LEVEL_CDEG) &&
         is_within(calibration.level_pitch_cdeg, GREATEST_LEVEL_CDEG);
}

bool read_calibration(const uint8_t* bytes, Calibration& calibration) {
  Calibration staged;
  WireReader reader(bytes);
  for (uint8_t axis = 0; axis < 3; ++axis) staged.gyro_bias_16[axis] = reader.i16();
  staged.level_roll_cdeg = reader.i16();
  staged.level_pitch_cdeg = reader.i16();
  for (uint8_t channel = 0; channel < INPUTS; ++channel) {
    ChannelRange& range = staged.receiver[channel];
    range.lowest_us = reader.u16();
    range.centre_us = reader.u16();
    range.highest_us = reader.u16();
  }
  if (!is_in_range(staged)) return false;
  calibration = staged;
  return true;
}

void write_calibration(const Calibration& calibration, uint8_t* bytes) {
  WireWriter writer(bytes);
  for (uint8_t axis = 0; axis < 3; ++axis) writer.i16(calibration.gyro_bias_16[axis]);
  writer.i16(calibration.level_roll_cdeg);
  writer.i16(calibration.level_pitch_cdeg);
  for (uint8_t channel = 0; channel < INPUTS; ++channel) {
    const ChannelRange& range = calibration.receiver[channel];
    writer.u16(range.lowest_us);
    writer.u16(range.centre_us);
    writer.u16(range.highest_us);
  }
}

}  // namespace raspilot
