/** One channel of the receiver: which of its edges make a pulse, and whether it is alive. */
#pragma once

#include "../core/types.h"
#include "../store/calibration.h"
#include "pulse_filter.h"

namespace raspilot {

/**
 * A pulse counts when the line was low for 2.5 ms before it, as it is between two pulses of any
 * receiver. One that is followed by another edge within these 2.5 ms was a piece of a pulse, cut
 * by noise: it is taken back. Edges shorter than 300 us are noise.
 *
 * Stamps are Timer1 (0.5 us, wrapping at 32.768 ms); units are 1024 us, wrapping at 67 s.
 */
class InputChannel {
 public:
  enum Fall : uint8_t { NOISE, OUT_OF_RANGE, GOOD };

  explicit InputChannel(Ticks pulse);

  /** True when it proves the pulse before it: that one was followed by a rest. */
  bool on_rise(uint16_t stamp, bool is_late, uint16_t now_units, const ChannelRange& range);
  Fall on_fall(uint16_t stamp, bool is_late, uint16_t now_units, const ChannelRange& range);
  /** Edges were lost before `stamp`: nothing is known but the level. */
  void begin_again(uint16_t stamp);
  /** Ages it; each slot. */
  void check(bool is_high, uint16_t now_stamp, uint16_t now_units);

  Ticks pulse() const { return pulse_; }
  /** Filtered, before calibration. */
  Ticks raw() const { return filter_.pulse(); }
  uint16_t width() const { return width_; }
  uint16_t rise() const { return rise_; }
  bool is_valid() const { return is_valid_; }

  /** A good pulse came that was not taken back. */
  bool is_new : 1;
  /** It rose, and no output was slaved to it yet. */
  bool has_risen : 1;

 private:
  void note_fall(uint16_t stamp) { rise_ = static_cast<uint16_t>(stamp - width_); }
  uint16_t fell_at() const { return static_cast<uint16_t>(rise_ + width_); }
  void show(Ticks raw, const ChannelRange& range);

  bool is_valid_ : 1;
  bool is_measuring_ : 1;
  bool is_uncertain_ : 1;
  bool has_rested_ : 1;
  bool is_revocable_ : 1;
  bool is_unproven_ : 1;
  PulseFilter filter_;
  Ticks pulse_;
  Ticks before_;
  uint16_t rise_ = 0;
  uint16_t width_ = 0;
  uint16_t proven_at_ = 0;
};

}  // namespace raspilot
