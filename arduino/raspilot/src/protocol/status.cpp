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

}  // namespace

void write_status(const Autopilot& autopilot, uint32_t now_us) {
  const Authority& authority = autopilot.authority;
  Link::Frame::u8(PROTOCOL_VERSION);
  Link::Frame::u8(static_cast<uint8_t>(authority.mode()));
  Link::Frame::u8(authority.switch_position());
  Link::Frame::u8(flags_of(autopilot, now_us));
  Link::Frame::u8(authority.vetoes());
  Link::Frame::u8(autopilot.reset_cause);
  Link::Frame::u16(autopilot.meter.period_us());
  Link::Frame::u16(autopilot.meter.late_us());
  Link::Frame::u16(autopilot.link.dropped());
  Link::Frame::u16(autopilot.link.missing());
  Link::Frame::u16(autopilot.meter.seconds());
  Link::Frame::u16(autopilot.receiver.age_ms(now_us));
  Link::Frame::u16(autopilot.attitude.age_ms());
  Link::Frame::u16(autopilot.battery.mv(autopilot.settings.battery_full_scale_mv));
  Link::Frame::u8(autopilot.attitude.acceleration());
}

}  // namespace raspilot
