/** Measures the slots for the status: mean period and greatest lateness of the last whole second. */
#pragma once

#include <stdint.h>

namespace raspilot {

constexpr uint16_t SLOT_US = 2000;

class LoopMeter {
 public:
  /** A slot begins now that was due at `due_us`. */
  void on_slot(uint32_t due_us, uint32_t now_us);
  uint16_t period_us() const;
  uint16_t late_us() const;
  /** Whole seconds since reset, stays at 65535. */
  uint16_t seconds() const;
  /** Slots that did not end before the next was due. */
  uint16_t overruns() const;

 private:
  uint32_t second_us_ = 0;
  uint32_t newest_us_ = 0;
  uint16_t slots_ = 0;
  uint16_t period_us_ = 0;
  uint16_t late_us_ = 0;
  uint16_t latest_us_ = 0;
  uint16_t seconds_ = 0;
  uint16_t overruns_ = 0;
  bool has_begun_ = false;
};

}  // namespace raspilot
