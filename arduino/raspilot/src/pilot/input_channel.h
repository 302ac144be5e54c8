/** One channel of the receiver: which of its edges make a pulse, and whether it is alive. */
#pragma once

#include "../core/compiler.h"
#include "../core/types.h"
#include "../store/calibration.h"
#include "pulse_filter.h"

namespace raspilot {

/**
 * A pulse counts when the line was low for 2.5 ms before it, the case between two pulses of any
 * receiver. One that is followed by another edge within these 2.5 ms was a piece of a pulse, cut
 * by noise: it is withdrawn. Edges shorter than 300 us are noise.
 *
 * Stamps are Timer1 (0.5 us, wrapping at 32.768 ms), units those of lifetime.h.
 */
class InputChannel {
 public:
  enum Fall : uint8_t { NOISE, OUT_OF_RANGE, GOOD };

  /** Its value before its first pulse. */
  void begin(Ticks pulse);

  /** True when it proves the pulse before it: that one was followed by a rest. */
  bool on_rise(uint16_t stamp, bool is_late);
  Fall on_fall(uint16_t stamp, bool is_late);
  /** Edges were lost before `stamp`: only the level is known. */
  void begin_again(uint16_t stamp);
  /** Ages it, and shows its newest pulse; each slot. */
  void check(bool is_high, uint16_t now_stamp, uint8_t passed_units, const ChannelRange& range);

  /** Filtered and calibrated, ticks. */
  Ticks pulse() const { return pulse_; }
  /** Filtered, before calibration. */
  Ticks raw() const { return filter_.pulse(); }
  /** Of the newest pulse as it was measured, ticks. */
  uint16_t width() const { return width_; }
  uint16_t rise() const { return rise_; }
  bool is_valid() const { return flags_ & VALID; }
  /** It rose and is valid; true once each rise. */
  bool take_rise();

 private:
  enum Flag : uint8_t {
    VALID = 1,
    CHANGED = 2,
    RISEN = 4,
    MEASURING = 8,
    UNCERTAIN = 16,
    RESTED = 32,
    REVOCABLE = 64,
    // Its validity began with the pulse that may still be taken back.
    UNPROVEN = 128
  };

  void note_fall(uint16_t stamp) { rise_ = static_cast<uint16_t>(stamp - width_); }
  uint16_t fell_at() const { return static_cast<uint16_t>(rise_ + width_); }

  PulseFilter filter_;
  Ticks pulse_ ZEROED;
  Ticks before_ ZEROED;
  uint16_t rise_ ZEROED;
  uint16_t width_ ZEROED;
  /** Since a pulse was proven, units. */
  uint8_t age_ ZEROED;
  uint8_t flags_ ZEROED;
};

}  // namespace raspilot
