/** The flight battery: pin A7 behind a divider, low-passed, and its voltage by the divider's scale. */
#pragma once

#include <stdint.h>

#include "compiler.h"
#include "status_schema.h"

namespace raspilot {

class Battery {
 public:
  /** A conversion of the ADC, 0 to 1023, every 20 ms: the time constant is 1.3 s. */
  void on_count(uint16_t count);
  /**
   * mV by the battery's voltage that makes the pin 1.1 V (`full_scale_mv`, 0: no divider). 0 while
   * unknown: no divider, nothing measured, or the pin at the ADC's end.
   */
  uint16_t mv(uint16_t full_scale_mv) const;
  /** Finds the full scale at which the voltage is `mv`; `mv` 0: no divider. */
  Reason calibrate(uint16_t mv, uint16_t& full_scale_mv) const;

 private:
  bool is_saturated() const;

  /** Sixty-fourths of a count; 0 before the first. */
  uint16_t level_ ZEROED;
};

}  // namespace raspilot
