/** Finds checked frames in the bytes of the line (docs/protocols.md 2.1). */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"
#include "cobs.h"
#include "crc16.h"
#include "frame.h"

namespace raspilot {

class CheckedReader {
 public:
  enum class Found : uint8_t { NOTHING, FRAME, BROKEN };

  /** Takes one byte; a FRAME stays readable until the next byte is taken. */
  Found receive(uint8_t byte, uint32_t now_us);
  /** Drops a frame that is unfinished 100 ms after its first byte; true when there was one. */
  bool expire(uint32_t now_us);

  uint8_t sequence() const { return buffer_[0]; }
  char type() const { return static_cast<char>(buffer_[1]); }
  /** MAX_COMMAND bytes of it at most. */
  const uint8_t* payload() const { return buffer_ + 2; }
  uint8_t payload_size() const { return payload_size_; }

 private:
  void restart();

  CobsDecoder cobs_;
  Crc16 crc_;
  Beginning beginning_;
  uint8_t length_ ZEROED;
  uint8_t payload_size_ ZEROED;
  bool has_begun_ ZEROED;
  bool is_too_long_ ZEROED;
  /** Of a frame that is longer than any Command the rest is checked and not kept. */
  uint8_t buffer_[MAX_COMMAND + 2] ZEROED;
};

}  // namespace raspilot
