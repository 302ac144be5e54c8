/** Consistent Overhead Byte Stuffing (Cheshire and Baker 1999), byte by byte. */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"

namespace raspilot {

/** Takes the bytes of one frame without its closing zero, as they arrive. */
class CobsDecoder {
 public:
  enum class Step : uint8_t { NOTHING, BYTE };

  /** Takes one byte, never zero; after BYTE the decoded one is in `decoded`. */
  Step receive(uint8_t encoded, uint8_t& decoded) {
    if (left_ != 0) {
      --left_;
      decoded = encoded;
      return Step::BYTE;
    }
    const bool is_zero_due = is_zero_next_;
    left_ = static_cast<uint8_t>(encoded - 1);
    is_zero_next_ = encoded != 0xFF;
    if (!is_zero_due) return Step::NOTHING;
    decoded = 0;
    return Step::BYTE;
  }
  /** Whether the frame may end here: no code pointed beyond the end. */
  bool is_complete() const { return left_ == 0; }
  void restart() {
    left_ = 0;
    is_zero_next_ = false;
  }

 private:
  uint8_t left_ ZEROED;
  bool is_zero_next_ ZEROED;
};

/** Writes encoded frames: `PUT` takes each byte with its place, not always the next one. */
template <void (*PUT)(uint8_t at, uint8_t byte)>
class CobsEncoder {
 public:
  void begin() {
    code_ = 0;
    end_ = 1;
  }
  /** At most 253 bytes: longer blocks would need a code of 255, which no frame of ours has. */
  void put(uint8_t byte) {
    if (byte == 0) {
      close();
      code_ = end_;
    } else {
      PUT(end_, byte);
    }
    ++end_;
  }
  /** Ends the frame and returns where its zero belongs. */
  uint8_t finish() {
    close();
    return end_;
  }

 private:
  void close() { PUT(code_, static_cast<uint8_t>(end_ - code_)); }

  uint8_t code_ ZEROED;
  uint8_t end_ ZEROED;
};

}  // namespace raspilot
