/**
 * Reads the receiver's pulses from stamped edges (thesis 4.4.4): the interrupts store, this decides.
 */
#pragma once

#include "../core/types.h"
#include "../store/calibration.h"

namespace raspilot {

class PwmReader {
 public:
  explicit PwmReader(const Calibration& calibration);

  /**
   * Takes one stored edge: Timer1 at the edge, the levels of the six inputs (bit = Channel), and
   * whether the stamp may be a few microseconds late. `now_us` is the clock now.
   */
  void on_edge(uint16_t stamp_ticks, uint8_t levels, bool is_late, uint32_t now_us);
  /** Forgets channels without a good pulse for 100 ms; each slot. */
  void check(uint32_t now_us);

  /** The channel's newest good pulse, calibrated to 1000..1500..2000 us and filtered, in ticks. */
  Ticks pulse(Channel channel) const;
  /** The newest pulse as measured, us, whatever its width; 0 before the first. */
  uint16_t measured_us(Channel channel) const;
  /** A bit a channel: fresh (100 ms) and within 885 to 2115 us. */
  uint8_t validity() const;
  /** Age of the newest pulse of any channel, ms, at most 65535. */
  uint16_t age_ms(uint32_t now_us) const;
  /** Whether all six came anew since the last call. */
  bool take_frame();
  /**
   * The Timer1 stamp of the newest rising edge of a servo channel whose last pulse was good, once
   * each: the output is slaved to it.
   */
  bool take_rise(Channel channel, uint16_t& stamp_ticks);

  /** End points are learned between these two; false (and nothing kept) when a range is too small. */
  void begin_range_learning();
  bool end_range_learning(Calibration& learned);
  bool is_learning() const;
};

}  // namespace raspilot
