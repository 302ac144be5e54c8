/**
 * The streams to the Raspberry Pi: receiver inputs, orientation, outputs, status
 * (docs/protocols.md 2.4), each at its period; the newest wins.
 */
#pragma once

#include <stdint.h>

#include "../core/reference.h"
#include "../core/compiler.h"
#include "../core/types.h"

#ifndef RASPILOT_BAUD
#define RASPILOT_BAUD 115200L
#endif

namespace raspilot {

class Autopilot;

class Forwarder {
 public:
  explicit Forwarder(Autopilot& autopilot) : autopilot_(autopilot) {}

  /** Forwarding begins; a second call has no effect. */
  void start(uint32_t now_us);
  bool is_started() const { return is_started_; }
  /** Panic: the period of all but the status, 10 to 1000 ms. */
  void set_period_ms(uint16_t period_ms) { period_ms_ = period_ms; }

  /** Sends at most one message that is due and fits; false when none does. */
  bool send_next(uint32_t now_us);
  /** The most that the orientation of this sequence is old, us; NEVER beyond the last 100 ms. */
  uint32_t orientation_age_us(uint16_t sequence, uint32_t now_us) const;
  /** Forgets orientations that are too old to be computed from; at least every 150 ms. */
  void check(uint32_t now_us);

  static constexpr uint32_t NEVER = 0xFFFFFFFF;

 private:
  enum Stream : uint8_t { INPUTS_STREAM, ORIENTATION_STREAM, OUTPUTS_STREAM, STATUS_STREAM };
  static constexpr uint8_t STREAMS = 4;
  /** A power of two; at 20 ms five orientations are younger than 100 ms. */
  static constexpr uint8_t REMEMBERED = 16;

  /** A time or how long it lasts, in steps of 32 us: two seconds, twice the longest period. */
  typedef uint16_t Steps;

  static Steps to_steps(uint32_t time_us);
  Steps period(uint8_t stream) const;
  bool is_due(uint8_t stream, Steps now);
  bool is_remembered(uint8_t now_units) const;
  bool send(uint8_t stream, uint32_t now_us);
  bool send_inputs();
  bool send_outputs();
  bool send_orientation(uint32_t now_us);
  bool send_status(uint32_t now_us);

  Reference<Autopilot> autopilot_;
  Steps due_[STREAMS] ZEROED;
  /** When the newest orientations were sent, by sequence modulo REMEMBERED: the clock's units. */
  uint8_t sent_[REMEMBERED] ZEROED;
  uint16_t sequence_ ZEROED;
  uint16_t period_ms_ ZEROED;
  uint8_t remembered_ ZEROED;
  uint8_t next_ ZEROED;
  bool is_started_ ZEROED;
};

}  // namespace raspilot
