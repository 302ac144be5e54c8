#include "status.h"

#include "../core/autopilot.h"
#include "../store/wire_bytes.h"

namespace raspilot {

namespace {

constexpr uint8_t VERSION = 1;

enum Flag : uint8_t {
  ARMED = 1,
  AT_AUTO = 2,
  RECEIVER_VALID = 4,
  IMU_VALID = 8,
  FAILSAFE_ACTS = 16,
  BIAS_FROM_EEPROM = 32,
  GAINS_IN_EEPROM = 64,
  RASPBERRY_HEARD = 128
};

uint8_t flags_of(const Autopilot& autopilot, uint32_t now_us) {
  const Authority& authority = autopilot.authority;
  uint8_t flags = 0;
  if (authority.is_armed()) flags |= ARMED;
  if (authority.is_auto()) flags |= AT_AUTO;
  if (authority.has_receiver()) flags |= RECEIVER_VALID;
  if (autopilot.attitude.is_valid()) flags |= IMU_VALID;
  if (authority.is_failsafe()) flags |= FAILSAFE_ACTS;
  if (autopilot.attitude.is_bias_from_eeprom()) flags |= BIAS_FROM_EEPROM;
  if (autopilot.settings.has_gains()) flags |= GAINS_IN_EEPROM;
  if (autopilot.link.has_heard(now_us)) flags |= RASPBERRY_HEARD;
  return flags;
}

}  // namespace

void write_status(const Autopilot& autopilot, uint32_t now_us, uint8_t* payload) {
  const Authority& authority = autopilot.authority;
  WireWriter writer(payload);
  writer.u8(VERSION);
  writer.u8(static_cast<uint8_t>(authority.mode()));
  writer.u8(authority.switch_position());
  writer.u8(flags_of(autopilot, now_us));
  writer.u8(authority.vetoes());
  writer.u8(autopilot.reset_cause);
  writer.u16(autopilot.meter.period_us());
  writer.u16(autopilot.meter.late_us());
  writer.u16(autopilot.link.dropped());
  writer.u16(autopilot.link.missing());
  writer.u16(autopilot.meter.seconds());
  writer.u16(autopilot.receiver.age_ms(now_us));
  writer.u16(autopilot.attitude.age_ms(now_us));
}

}  // namespace raspilot
