/** The flight battery: pin A7 behind a divider, low-passed, and its voltage by the divider's scale. */
#pragma once

#include <stdint.h>

#include "compiler.h"

namespace raspilot {

class Battery {
 public:
  /**
   * A conversion of the ADC, 0 to 1023, every 20 ms: the time constant is 1.3 s. One at the ADC's
   * end makes the voltage unknown until the next, which starts the filter again.
   */
  void on_count(uint16_t count);
  /** The voltage, mV, by that at which the pin has 1.1 V (0: no divider); 0 while unknown. */
  uint16_t mv(uint16_t full_scale_mv) const;
  /**
   * Finds the full scale at which the voltage is `mv`; 0 mV: there is no divider. False while the
   * voltage is unknown, and for a full scale above 65 V.
   */
  bool calibrate(uint16_t mv, uint16_t& full_scale_mv) const;

 private:
  /** Sixty-fourths of a count; 0: unknown. */
  uint16_t level_ ZEROED;
};

}  // namespace raspilot
