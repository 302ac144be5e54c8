/** Everything that flies, apart from the chip: its parts, and the order in which a slot runs. */
#pragma once

#include "battery.h"
#include "compiler.h"
#include "../control/attitude_filter.h"
#include "../control/flight_controller.h"
#include "../pilot/authority.h"
#include "../pilot/pwm_reader.h"
#include "../protocol/link.h"
#include "../store/saved_state.h"
#include "../store/settings.h"
#include "loop_meter.h"
#include "types.h"

namespace raspilot {

class Autopilot {
 public:
  Autopilot();

  /**
   * Loads the settings. `kept` is the state from before the reset, null when memory lost it: after
   * a watchdog reset all of it flies on, after any other attitude and gyro bias, never arming.
   */
  void begin(const SavedState* kept, uint8_t reset_cause, uint32_t now_us);
  /** One slot of 2000 us: receiver, authority, attitude, control. `sample` is null without one. */
  void control(const ImuSample* sample, uint32_t now_us);
  /** One piece of background work of at most 100 us; false without work. */
  bool background(uint32_t now_us);

  SavedState state() const;

  Settings settings;
  PwmReader receiver;
  Authority authority;
  AttitudeFilter attitude;
  FlightController controller;
  Link link;
  LoopMeter meter;
  Battery battery;
  uint8_t reset_cause ZEROED;

 private:
  Demand demand() const;

  /** Settings and link take turns, so that neither starves the other. */
  bool is_settings_turn_ ZEROED;
};

}  // namespace raspilot
