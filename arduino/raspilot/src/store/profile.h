/** The airframe as `C` carries it and EEPROM keeps it (docs/protocols.md 2.6). */
#pragma once

#include <stdint.h>

#include "../core/types.h"

namespace raspilot {

constexpr uint8_t PROFILE_SIZE = 54;

enum class Mix : uint8_t { NONE = 0, ELEVON = 1, V_TAIL = 2 };

/** One servo output: direction, trim and end points. */
struct ServoSetup {
  bool is_reversed;
  int16_t trim_us;
  uint16_t lowest_us;
  uint16_t highest_us;
};

/** Bits of Profile::flags: what the Raspberry Pi may do while the receiver is lost. */
constexpr uint8_t RETURN_WITH_MOTOR = 1;
constexpr uint8_t PI_MAY_FLY = 2;
constexpr uint8_t SLEW_UNIT = 4;

/** Everything that differs from airframe to airframe. */
struct Profile {
  ServoSetup servos[OUTPUTS];
  Mix mix;
  bool has_motor;
  /** The modes of AUX1 low, middle and high: `a`, `r`, `f` or `A` (AUTO). */
  char switch_modes[3];
  int16_t roll_limit_cdeg;
  int16_t pitch_up_limit_cdeg;
  int16_t pitch_down_limit_cdeg;
  int16_t glide_pitch_cdeg;
  int16_t circle_bank_cdeg;
  uint16_t throttle_failsafe_us;
  uint16_t throttle_lost_us;
  uint16_t preset_ailerons_us;
  uint16_t preset_elevator_us;
  uint16_t preset_rudder_us;
  /** The two bits above, and in units of SLEW_UNIT the throttle's slew limit. */
  uint8_t flags;

  bool may_return_with_motor() const { return flags & RETURN_WITH_MOTOR; }
  bool may_pi_fly() const { return flags & PI_MAY_FLY; }
  /** How far the throttle may rise in 10 ms, ticks: 1 is 5 %/s; 0 is no limit. */
  uint8_t throttle_slew() const { return static_cast<uint8_t>(flags / SLEW_UNIT); }
};

/** The profile that the firmware boots with while EEPROM holds none. In flash: copy with memcpy_P. */
extern const Profile DEFAULT_PROFILE;

/** Reads the 54 bytes of `C`; false and `profile` untouched when one value is out of range. */
bool read_profile(const uint8_t* wire, Profile& profile);
/** Writes the 54 bytes of `C`. */
void write_profile(const Profile& profile, uint8_t* wire);

}  // namespace raspilot
