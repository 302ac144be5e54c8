#include "status.h"

#include "../core/autopilot.h"
#include "../core/compiler.h"

namespace raspilot {

namespace {

uint8_t flags_of(const Autopilot& autopilot, uint32_t now_us) {
  const Authority& authority = autopilot.authority;
  uint8_t flags = 0;
  if (authority.is_armed()) flags |= FLAG_ARMED;
  if (authority.is_auto()) flags |= FLAG_AT_AUTO;
  if (authority.has_receiver()) flags |= FLAG_RECEIVER_VALID;
  if (autopilot.attitude.is_valid()) flags |= FLAG_IMU_VALID;
  if (authority.is_failsafe()) flags |= FLAG_FAILSAFE;
  if (autopilot.attitude.is_bias_from_eeprom()) flags |= FLAG_BIAS_STORED;
  if (autopilot.settings.has_gains()) flags |= FLAG_GAINS_STORED;
  if (autopilot.link.has_received(now_us)) flags |= FLAG_PI_RECEIVED;
  return flags;
}

OUT_OF_LINE void put_u16(uint8_t* bytes, uint16_t value) {
  bytes[0] = static_cast<uint8_t>(value >> 8);
  bytes[1] = static_cast<uint8_t>(value);
}

}  // namespace

void write_status(const Autopilot& autopilot, uint32_t now_us, uint8_t* payload) {
  const Authority& authority = autopilot.authority;
  payload[AT_VERSION] = PROTOCOL_VERSION;
  payload[AT_MODE] = static_cast<uint8_t>(authority.mode());
  payload[AT_SWITCH] = authority.switch_position();
  payload[AT_FLAGS] = flags_of(autopilot, now_us);
  payload[AT_VETOES] = authority.vetoes();
  payload[AT_RESET_CAUSE] = autopilot.reset_cause;
  put_u16(payload + AT_LOOP_US, autopilot.meter.period_us());
  put_u16(payload + AT_LATE_US, autopilot.meter.late_us());
  put_u16(payload + AT_FRAME_ERRORS, autopilot.link.dropped());
  put_u16(payload + AT_FRAMES_LOST, autopilot.link.missing());
  put_u16(payload + AT_UPTIME_S, autopilot.meter.seconds());
  put_u16(payload + AT_RX_AGE_MS, autopilot.receiver.age_ms(now_us));
  put_u16(payload + AT_IMU_AGE_MS, autopilot.attitude.age_ms());
  const uint16_t full_scale_mv = autopilot.settings.battery_full_scale_mv;
  put_u16(payload + AT_BATTERY_MV, autopilot.battery.mv(full_scale_mv));
}

}  // namespace raspilot
