/**
 * Reads the receiver's pulses from stamped edges (thesis 4.4.4): the interrupts store, this
 * decides.
 */
#pragma once

#include "../core/reference.h"
#include "../core/compiler.h"
#include "../core/types.h"
#include "../store/calibration.h"
#include "input_channel.h"
#include "lifetime.h"
#include "range_learner.h"

namespace raspilot {

class PwmReader {
 public:
  explicit PwmReader(const Calibration& calibration);

  /**
   * Takes one stored edge: Timer1 at the edge, the levels of the six inputs (bit = Channel), and
   * whether the stamp may be a few microseconds late. `now_us` is the clock now.
   */
  void on_edge(uint16_t stamp_ticks, uint8_t levels, bool is_late, uint32_t now_us);
  /** Edges were lost (the ring was full): pulses being measured are discarded. */
  void on_lost_edges() { is_lost_ = true; }
  /** Shows the newest pulses, forgets channels without a good one for 100 ms; each slot. */
  void check(uint32_t now_us);

  /**
   * The channel's newest good pulse, calibrated to 1000..1500..2000 us and filtered, in ticks;
   * before the first 1500 us, the throttle's 1000 us.
   */
  Ticks pulse(Channel channel) const { return channels_[channel].pulse(); }
  /** The newest pulse as measured, us, whatever its width; 0 before the first. */
  uint16_t measured_us(Channel channel) const;
  /** A bit a channel: fresh (100 ms) and within 885 to 2115 us. */
  uint8_t validity() const;
  /** Age of the newest pulse of any channel, ms, at most 65535, which it is before the first. */
  uint16_t age_ms(uint32_t now_us) const;
  /**
   * The Timer1 stamp of the newest rising edge of a servo channel whose last pulse was good, once
   * each: the output is slaved to it.
   */
  bool take_rise(Channel channel, uint16_t& stamp_ticks);

  /** End points are learned from here to there; false, and nothing kept, as in RangeLearner. */
  void begin_range_learning() { learner_.begin(); }
  bool end_range_learning(Calibration& learned);
  bool is_learning() const { return learner_.is_learning(); }

 private:
  uint16_t passed_units(uint32_t now_us) const;

  Reference<const Calibration> calibration_;
  // Small members lie where one instruction reaches them.
  Stopwatch age_;
  uint16_t checked_at_ ZEROED;
  uint8_t levels_ ZEROED;
  bool is_lost_ = true;
  RangeLearner learner_;
  InputChannel channels_[INPUTS];
};

}  // namespace raspilot
