/** `C` `c` `e` `V`: the airframe's profile, and calibrating; neither changes in flight. */
#include "../../core/autopilot.h"
#include "../command_executor.h"

namespace raspilot {
namespace {

enum What : uint8_t { LEVEL, ENDS_BEGIN, ENDS_END, GYRO };

bool is_in_flight(const Autopilot& autopilot) {
  return autopilot.authority.is_in_flight(autopilot.meter.seconds());
}

Reason on_profile(Autopilot& autopilot, const Request& request) {
  Profile profile;
  if (!read_profile(request.payload, profile)) return Reason::OUT_OF_RANGE;
  if (is_in_flight(autopilot)) return Reason::ONLY_ON_GROUND;
  autopilot.settings.profile = profile;
  autopilot.settings.save_profile();
  return Reason::NONE;
}

Reason on_profile_asked(Autopilot& autopilot, const Request&) {
  uint8_t payload[PROFILE_SIZE];
  write_profile(autopilot.settings.profile, payload);
  autopilot.link.send('C', payload, sizeof payload);
  return Reason::NONE;
}

/** Ending without a beginning is out of range; so are end points too close to each other. */
Reason end_learning(Autopilot& autopilot) {
  PwmReader& receiver = autopilot.receiver;
  return receiver.is_learning() && receiver.end_range_learning(autopilot.settings.calibration)
             ? Reason::NONE
             : Reason::OUT_OF_RANGE;
}

Reason on_calibrate(Autopilot& autopilot, const Request& request) {
  const uint8_t what = request.payload[0];
  if (what > GYRO) return Reason::OUT_OF_RANGE;
  // The end points of a glider need its transmitter, which was off when they began.
  if (autopilot.authority.is_armed() || (what != ENDS_END && is_in_flight(autopilot))) {
    return Reason::ONLY_ON_GROUND;
  }
  if (what == ENDS_BEGIN) {
    autopilot.receiver.begin_range_learning();
    return Reason::NONE;
  }
  const Reason reason = what == LEVEL      ? autopilot.attitude.calibrate_level()
                        : what == ENDS_END ? end_learning(autopilot)
                                           : autopilot.attitude.calibrate_gyro();
  if (reason == Reason::NONE) autopilot.settings.save_calibration();
  return reason;
}

Reason on_battery(Autopilot& autopilot, const Request& request) {
  if (is_in_flight(autopilot)) return Reason::ONLY_ON_GROUND;
  const uint16_t mv = static_cast<uint16_t>(request.payload[0] << 8 | request.payload[1]);
  Settings& settings = autopilot.settings;
  if (!autopilot.battery.calibrate(mv, settings.battery_full_scale_mv)) {
    return Reason::BATTERY_NOT_MEASURED;
  }
  settings.save_battery();
  return Reason::NONE;
}

const CommandDefinition COMMANDS[] REGISTERED = {
    {'C', PROFILE_SIZE, Answer::CONFIRMED, on_profile},
    {'c', 0, Answer::OWN, on_profile_asked},
    {'e', 1, Answer::CONFIRMED, on_calibrate},
    {'V', 2, Answer::CONFIRMED, on_battery},
};

}  // namespace
}  // namespace raspilot
