/** Learns where a receiver's channels end and rest, because makers differ (thesis 2.4.1). */
#pragma once

#include "../core/compiler.h"
#include "../core/types.h"
#include "../store/calibration.h"

namespace raspilot {

/**
 * Keeps the smallest and the greatest pulse of each channel from begin() to end().
 *
 * The pilot moves all sticks and switches to their ends, then centres ailerons, elevator and rudder
 * before end(): their positions then are their centres. Throttle and the switches have no rest
 * position: the middle of their range is their centre.
 */
class RangeLearner {
 public:
  void begin();
  /** Takes a good pulse; ignored while not learning. */
  void update(uint8_t channel, uint16_t width_ticks);
  /**
   * Ends learning; `resting` are the newest pulses, ticks. False, and `ranges` untouched, when
   * it had not begun or a centre is within 200 us of an end.
   */
  bool end(const Ticks* resting, ChannelRange* ranges);
  bool is_learning() const { return is_learning_; }

 private:
  struct Ends {
    uint16_t lowest, highest;
  };

  Ends ends_[INPUTS];
  bool is_learning_ ZEROED;
};

/** The pulse on the scale 1000, 1500, 2000 us, ticks; extrapolated beyond the ends. */
Ticks calibrated(const ChannelRange& range, Ticks pulse);

}  // namespace raspilot
