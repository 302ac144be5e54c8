/**
 * Decides from the bytes before the first checked frame whether the other side speaks thesis
 * framing (docs/protocols.md 2.2). It keeps no payload: the Commands that open are not carried out.
 */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"
#include "frame.h"

namespace raspilot {

/**
 * Counts an unbroken run of complete thesis Commands in range. Points measure how improbable a
 * Command is by chance, in units of about 5 bits: a bare `T` or any three bytes that begin with `h`
 * count nothing, forty-eight bytes that are twelve gains count all. A run of random bytes reaches
 * the eight points needed about once in 10^10 beginnings.
 */
class LegacyFramingDetector {
 public:
  /** Takes one byte; true when the run is long and improbable enough. */
  bool receive(uint8_t byte, uint32_t now_us);
  /** Breaks a run whose Command is unfinished after 100 ms. */
  void expire(uint32_t now_us);

 private:
  void begin(char type, uint32_t now_us);
  bool is_field_good() const;
  void break_run();

  uint32_t window_ ZEROED;
  Beginning beginning_;
  char type_ ZEROED;
  uint8_t left_ ZEROED;
  /** Points of the Command that is being taken. */
  uint8_t worth_ ZEROED;
  uint8_t points_ ZEROED;
  uint8_t commands_ ZEROED;
};

}  // namespace raspilot
