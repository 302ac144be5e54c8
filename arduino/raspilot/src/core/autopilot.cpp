#include "autopilot.h"

namespace raspilot {

Autopilot::Autopilot()
    : receiver(settings.calibration),
      authority(settings.profile, receiver),
      attitude(settings.calibration),
      controller(settings.profile, settings.gains),
      link(*this) {}

void Autopilot::begin(const SavedState* kept, uint8_t cause, uint32_t now_us) {
  reset_cause = cause;
  settings.load();
  controller.on_gains();
  attitude.begin();
  // A reset without power-on may come in flight, where a steady turn is still: an old bias is
  // better than that turn.
  const bool may_fly = cause != 0 && !(cause & RESET_POWER_ON);
  if (may_fly && attitude.has_bias()) attitude.stop_calibrating();
  if (kept == nullptr) return;
  attitude.restore(kept->attitude);
  if (cause != RESET_WATCHDOG) return;
  reset_cause |= RESET_RESTORED;
  authority.restore(kept->authority, now_us);
}

void Autopilot::control(const ImuSample* sample, uint32_t now_us) {
  receiver.check(now_us);
  if (authority.is_armed() || (!settings.profile.has_motor && attitude.has_searched_long())) {
    attitude.stop_calibrating();
  }
  if (sample != nullptr) {
    attitude.on_sample(*sample);
  } else {
    attitude.on_missing();
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
  demand.asked = authority.asked();
  return demand;
}

bool Autopilot::background(uint32_t now_us) {
  link.check(now_us);
  if (attitude.take_new_bias()) settings.save_calibration();
  is_settings_turn_ = !is_settings_turn_;
  if (is_settings_turn_ && settings.background(authority.is_armed())) return true;
  return link.background(now_us);
}

SavedState Autopilot::state() const { return SavedState{authority.state(), attitude.state()}; }

}  // namespace raspilot
