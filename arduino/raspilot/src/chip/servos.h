/** When each servo gets its next pulse: slaved to its own channel of the receiver. */
#pragma once

#include "../core/types.h"
#include "../pilot/pwm_reader.h"

namespace raspilot {

/**
 * An output rises 5 ms after its channel of the receiver did, with the pulse valid at that time: a
 * constant latency at the receiver's own rate, which its servos tolerate. Without pulses it runs
 * freely, every 20 ms. Two rises are never closer than 6 ms, whatever the inputs do.
 */
class Servos {
 public:
  void begin();
  /** Plans the rises until the end of the next slot; when a slot begins. */
  void plan(PwmReader& receiver);
  /** Takes the pulses over: each holds from its output's next rise. */
  void set(const Outputs& outputs);

 private:
  struct Plan {
    uint16_t rise;
    uint16_t next;
    uint8_t slots;
    bool has_next : 1;
    bool is_free : 1;
  };

  void plan_channel(Channel channel, uint16_t now);

  Plan plans_[OUTPUTS];
};

}  // namespace raspilot
