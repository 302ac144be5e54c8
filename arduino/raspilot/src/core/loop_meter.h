/** Measures the slots for the status: mean period and greatest lateness of the last whole second. */
#pragma once

#include <stdint.h>

namespace raspilot {

constexpr uint16_t SLOT_US = 2000;
/** A slot that begins later than this had a predecessor that did not end in time. */
constexpr uint16_t MOST_LATE_US = 100;

class LoopMeter {
 public:
  /** A slot begins now that was due at `due_us`. */
  void on_slot(uint32_t due_us, uint32_t now_us);
  /** Mean of the last whole second; 0 in the first. */
  uint16_t period_us() const { return period_us_; }
  /** Greatest of the last whole second. */
  uint16_t late_us() const { return late_us_; }
  /** Whole seconds since reset, stays at 65535. */
  uint16_t seconds() const { return seconds_; }
  /** Slots that began more than MOST_LATE_US late since reset, stays at 65535. */
  uint16_t overruns() const { return overruns_; }

 private:
  void end_second(uint32_t now_us);

  uint32_t second_us_ = 0;
  uint32_t first_slot_us_ = 0;
  uint16_t slots_ = 0;
  uint16_t period_us_ = 0;
  uint16_t late_us_ = 0;
  uint16_t latest_us_ = 0;
  uint16_t seconds_ = 0;
  uint16_t overruns_ = 0;
  bool has_begun_ = false;
};

}  // namespace raspilot
