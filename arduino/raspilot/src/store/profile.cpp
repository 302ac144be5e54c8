#include "profile.h"

#include "../core/flash.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

constexpr int16_t GREATEST_TRIM_US = 200;
constexpr uint16_t LOWEST_PULSE_US = 800;
constexpr uint16_t HIGHEST_PULSE_US = 2200;
constexpr int16_t RIGHT_ANGLE_CDEG = 9000;

bool is_pulse(uint16_t us) { return us >= LOWEST_PULSE_US && us <= HIGHEST_PULSE_US; }

bool is_switch_mode(char letter) {
  return letter == 'a' || letter == 'r' || letter == 'f' || letter == 'A';
}

bool is_limit(int16_t cdeg) { return cdeg >= 0 && cdeg <= RIGHT_ANGLE_CDEG; }

bool is_angle(int16_t cdeg) { return cdeg >= -RIGHT_ANGLE_CDEG && cdeg <= RIGHT_ANGLE_CDEG; }

/** False when a byte that is a flag, a mix or a motor says what is not known. */
bool take_fields(WireReader reader, Profile& profile) {
  for (uint8_t output = 0; output < OUTPUTS; ++output) {
    ServoSetup& servo = profile.servos[output];
    const uint8_t flags = reader.u8();
    if (flags > 1) return false;
    servo.is_reversed = flags != 0;
    servo.trim_us = reader.i16();
    servo.lowest_us = reader.u16();
    servo.highest_us = reader.u16();
  }
  const uint8_t mix = reader.u8();
  const uint8_t motor = reader.u8();
  if (mix > static_cast<uint8_t>(Mix::V_TAIL) || motor > 1) return false;
  profile.mix = static_cast<Mix>(mix);
  profile.has_motor = motor != 0;
  for (uint8_t position = 0; position < 3; ++position) {
    profile.switch_modes[position] = static_cast<char>(reader.u8());
  }
  profile.roll_limit_cdeg = reader.i16();
  profile.pitch_up_limit_cdeg = reader.i16();
  profile.pitch_down_limit_cdeg = reader.i16();
  profile.glide_pitch_cdeg = reader.i16();
  profile.circle_bank_cdeg = reader.i16();
  profile.throttle_failsafe_us = reader.u16();
  profile.throttle_lost_us = reader.u16();
  profile.preset_ailerons_us = reader.u16();
  profile.preset_elevator_us = reader.u16();
  profile.preset_rudder_us = reader.u16();
  const uint8_t flags = reader.u8();
  profile.may_return_with_motor = flags != 0;
  return flags <= 1;
}

bool is_servo_in_range(const ServoSetup& servo) {
  return servo.trim_us >= -GREATEST_TRIM_US && servo.trim_us <= GREATEST_TRIM_US &&
         is_pulse(servo.lowest_us) && is_pulse(servo.highest_us) &&
         servo.lowest_us < servo.highest_us;
}

bool is_profile_in_range(const Profile& profile) {
  for (uint8_t output = 0; output < OUTPUTS; ++output) {
    if (!is_servo_in_range(profile.servos[output])) return false;
  }
  for (uint8_t position = 0; position < 3; ++position) {
    if (!is_switch_mode(profile.switch_modes[position])) return false;
  }
  return is_limit(profile.roll_limit_cdeg) && is_limit(profile.pitch_up_limit_cdeg) &&
         is_limit(profile.pitch_down_limit_cdeg) && is_angle(profile.glide_pitch_cdeg) &&
         is_angle(profile.circle_bank_cdeg) && is_pulse(profile.throttle_failsafe_us) &&
         profile.throttle_lost_us <= HIGHEST_PULSE_US && is_pulse(profile.preset_ailerons_us) &&
         is_pulse(profile.preset_elevator_us) && is_pulse(profile.preset_rudder_us);
}

}  // namespace

const Profile DEFAULT_PROFILE PROGMEM = {
    {{false, 0, 1000, 2000}, {false, 0, 1000, 2000}, {false, 0, 1000, 2000}, {false, 0, 1000, 2000}},
    Mix::NONE,
    true,
    {'a', 'f', 'A'},
    5000,
    2000,
    2500,
    -300,
    2000,
    1000,
    900,
    1500,
    1500,
    1500,
    false,
};

bool read_profile(const uint8_t* wire, Profile& profile) {
  Profile staged;
  if (!take_fields(WireReader(wire), staged) || !is_profile_in_range(staged)) return false;
  profile = staged;
  return true;
}

void write_profile(const Profile& profile, uint8_t* wire) {
  WireWriter writer(wire);
  for (uint8_t output = 0; output < OUTPUTS; ++output) {
    const ServoSetup& servo = profile.servos[output];
    writer.u8(servo.is_reversed);
    writer.i16(servo.trim_us);
    writer.u16(servo.lowest_us);
    writer.u16(servo.highest_us);
  }
  writer.u8(static_cast<uint8_t>(profile.mix));
  writer.u8(profile.has_motor);
  for (uint8_t position = 0; position < 3; ++position) {
    writer.u8(static_cast<uint8_t>(profile.switch_modes[position]));
  }
  writer.i16(profile.roll_limit_cdeg);
  writer.i16(profile.pitch_up_limit_cdeg);
  writer.i16(profile.pitch_down_limit_cdeg);
  writer.i16(profile.glide_pitch_cdeg);
  writer.i16(profile.circle_bank_cdeg);
  writer.u16(profile.throttle_failsafe_us);
  writer.u16(profile.throttle_lost_us);
  writer.u16(profile.preset_ailerons_us);
  writer.u16(profile.preset_elevator_us);
  writer.u16(profile.preset_rudder_us);
  writer.u8(profile.may_return_with_motor);
}

}  // namespace raspilot
