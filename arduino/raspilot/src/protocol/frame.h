/** Sizes of frames (docs/protocols.md 2.1). */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"
#include "../pilot/lifetime.h"

namespace raspilot {

/** Maximum payload of a frame, and that of any Command or answer of ours (`g` and `G`). */
constexpr uint8_t MAX_PAYLOAD = 96;
constexpr uint8_t MAX_COMMAND = 72;
/** Sequence, type, payload, CRC. */
constexpr uint8_t FRAME_OVERHEAD = 4;
constexpr uint8_t MAX_FRAME = MAX_PAYLOAD + FRAME_OVERHEAD;
/** The one byte that COBS adds, and the zero that ends a frame. */
constexpr uint8_t COBS_OVERHEAD = 2;

/** When the first byte of a frame came: an unfinished one is dropped after 100 ms. */
class Beginning {
 public:
  void note(uint32_t now_us) { units_ = to_units(now_us); }
  OUT_OF_LINE bool is_too_old(uint32_t now_us) const {
    return static_cast<uint16_t>(to_units(now_us) - units_) >= UNFINISHED_UNITS;
  }

 private:
  static constexpr uint16_t UNFINISHED_UNITS = units_at_least(100);

  uint16_t units_ ZEROED;
};

}  // namespace raspilot
