/** The eighteen gains as `g` carries them and EEPROM keeps them. */
#pragma once

#include <stdint.h>

namespace raspilot {

constexpr uint8_t GAINS_SIZE = 72;
constexpr float MAX_GAIN = 50.0f;

/** One PID's gains. Rate: units of 1.25 us per deg/s; stabilize: deg/s per degree. */
struct PidGains {
  float p, i, d;
};

/** Axes are ailerons, elevator, rudder. */
struct Gains {
  PidGains rate[3];
  PidGains stabilize[3];
};

/** For an untuned aircraft, as in pids.yml. In flash: copy with memcpy_P. */
extern const Gains DEFAULT_GAINS;

/** Reads the 72 bytes of `g`; false and `gains` untouched unless all are finite and 0 to 50. */
bool read_gains(const uint8_t* wire, Gains& gains);
void write_gains(const Gains& gains, uint8_t* wire);

}  // namespace raspilot
