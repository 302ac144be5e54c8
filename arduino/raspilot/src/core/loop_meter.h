/** Measures the slots for the status: mean period and greatest lateness of the last whole second. */
#pragma once

#include <stdint.h>

#include "compiler.h"

namespace raspilot {

constexpr uint16_t SLOT_US = 2000;

class LoopMeter {
 public:
  /** A slot begins now that was due at `due_us`: late when the one before did not end in time. */
  void on_slot(uint32_t due_us, uint32_t now_us);
  /** Mean of the last whole second; 0 in the first. */
  uint16_t period_us() const { return period_us_; }
  /** Greatest of the last whole second. */
  uint16_t late_us() const { return late_us_; }
  /** Whole seconds since reset, stays at 65535. */
  uint16_t seconds() const { return seconds_; }

 private:
  void end_second(uint32_t now_us);

  uint32_t second_us_;
  uint32_t first_slot_us_;
  uint16_t slots_ ZEROED;
  uint16_t period_us_ ZEROED;
  uint16_t late_us_ ZEROED;
  uint16_t latest_us_ ZEROED;
  uint16_t seconds_ ZEROED;
  bool has_begun_ ZEROED;
};

}  // namespace raspilot
