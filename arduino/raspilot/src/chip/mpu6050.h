/** The MPU6050 at the bus: set up, read once each slot, set up again when it was gone. */
#pragma once

#include "../control/attitude_filter.h"
#include "twi.h"

namespace raspilot {

/**
 * +-1000 deg/s, +-8 g, low-pass of 98 Hz, 1000 samples a second (register map RM-MPU-6000A-00).
 *
 * Each slot holds one transfer: begin(), pump() until the slot ends, end(). Any failure begins
 * again with freeing the bus and asking who answers; so do 25 samples that are equal, which is an
 * IMU that lost its power for a moment and fell asleep.
 */
class Mpu6050 {
 public:
  void begin();
  void begin_transfer();
  void pump() { twi_.pump(); }
  /** Ends this slot's transfer; one that has not ended by itself has failed. */
  void end_transfer();
  /** The sample of the newest transfer; null when that brought none. */
  const ImuSample* sample() const { return has_sample_ ? &sample_ : nullptr; }

 private:
  enum Step : uint8_t { FREE_BUS, WHO_AM_I, SETUP };

  void on_success();
  void take_sample();
  void start_over(uint8_t rest_slots);

  Twi twi_;
  ImuSample sample_;
  uint8_t bytes_[14];
  uint8_t step_;
  uint8_t rest_slots_;
  uint8_t equals_;
  bool is_resetting_;
  bool has_sample_;
};

}  // namespace raspilot
