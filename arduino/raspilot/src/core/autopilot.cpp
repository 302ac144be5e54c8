#include "autopilot.h"

namespace raspilot {

Autopilot::Autopilot()
    : receiver(settings.calibration),
      authority(settings.profile, receiver),
      attitude(settings.calibration),
      controller(settings.profile, settings.gains),
      link(*this),
      reset_cause(0) {}

void Autopilot::begin(const SavedState* restored, uint8_t cause, uint32_t now_us) {
  reset_cause = cause;
  settings.load();
  controller.on_gains();
  // What resets by itself may be flying: stillness there is a steady turn.
  const bool is_in_flight = (cause & (RESET_BROWN_OUT | RESET_WATCHDOG)) && !(cause & RESET_POWER_ON);
  if (is_in_flight) attitude.stop_calibrating();
  if (restored == nullptr) return;
  reset_cause |= RESET_RESTORED;
  authority.restore(restored->authority, now_us);
  attitude.restore(restored->attitude, now_us);
}

void Autopilot::control(const ImuSample* sample, uint32_t now_us) {
  receiver.check(now_us);
  if (authority.is_armed()) attitude.stop_calibrating();
  if (sample != nullptr) {
    attitude.on_sample(*sample, now_us);
  } else {
    attitude.on_missing(now_us);
  }
  const bool is_calibrating = attitude.is_calibrating() || receiver.is_learning();
  authority.update(attitude.is_valid(), is_calibrating, settings.is_broken(), now_us);
  controller.update(demand(), attitude.attitude());
}

Demand Autopilot::demand() const {
  Demand demand;
  demand.mode = authority.flown_mode();
  demand.is_failsafe = authority.is_failsafe();
  demand.is_imu_valid = attitude.is_valid();
  for (uint8_t channel = 0; channel < OUTPUTS; ++channel) {
    demand.sticks[channel] = receiver.pulse(static_cast<Channel>(channel));
  }
  demand.throttle = authority.throttle();
  demand.setpoint = authority.setpoint();
  demand.asked = authority.asked_outputs();
  return demand;
}

bool Autopilot::background(uint32_t now_us) {
  link.check(now_us);
  is_settings_turn_ = !is_settings_turn_;
  if (is_settings_turn_ && settings.background(authority.is_armed())) return true;
  return link.background(now_us);
}

SavedState Autopilot::state() const { return SavedState{authority.state(), attitude.state()}; }

}  // namespace raspilot
