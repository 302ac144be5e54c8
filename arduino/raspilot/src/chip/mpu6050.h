/** The MPU6050 at the bus: set up, read once each slot, set up again after a failure. */
#pragma once

#include "../control/attitude_filter.h"
#include "twi.h"

namespace raspilot {

/**
 * +-1000 deg/s, +-8 g, low-pass of 98 Hz, 1000 samples a second (register map RM-MPU-6000A-00).
 *
 * Each slot holds one transfer: begin_transfer(), pump() while it lasts, end_transfer(). Any
 * failure restarts with freeing the bus and reading the identity; so do 25 equal samples. An IMU
 * that kept its power continues immediately, one that fell asleep is set up again.
 */
class Mpu6050 {
 public:
  void begin();
  void begin_transfer();
  /** Whether this slot's transfer is still in progress. */
  bool pump() { return twi_.pump() == Twi::State::BUSY; }
  /** Ends this slot's transfer; one that has not completed has failed. */
  void end_transfer();
  /** The sample of the newest transfer; null if that has none. */
  const ImuSample* sample() const { return has_sample_ ? &sample_ : nullptr; }

 private:
  static constexpr uint8_t SETTINGS_COUNT = 6;
  enum Step : uint8_t { FREE_BUS, WHO_AM_I, POWER, SETUP, READY = SETUP + SETTINGS_COUNT };

  void on_success();
  void on_identity();
  void on_power();
  void take_sample();
  void start_over(uint8_t rest_slots);

  Twi twi_;
  /** Data as it arrives from the bus, then put in order in place. */
  union {
    ImuSample sample_;
    uint8_t bytes_[14];
  };
  uint16_t sum_;
  uint8_t step_;
  uint8_t rest_slots_;
  uint8_t equals_;
  bool is_transferring_;
  bool is_resetting_;
  bool is_awake_;
  bool is_set_up_;
  bool has_sample_;
};

}  // namespace raspilot
