#include "checked_reader.h"

#include "../core/compiler.h"

namespace raspilot {

CheckedReader::Found CheckedReader::receive(uint8_t byte, uint32_t now_us) {
  if (byte == 0) {
    if (!has_begun_) return Found::NOTHING;
    const bool is_frame = !is_too_long_ && cobs_.is_complete() && length_ >= FRAME_OVERHEAD &&
                          crc_.is_zero();
    payload_size_ = static_cast<uint8_t>(length_ - FRAME_OVERHEAD);
    restart();
    return is_frame ? Found::FRAME : Found::BROKEN;
  }
  if (!has_begun_) {
    has_begun_ = true;
    beginning_.note(now_us);
  }
  uint8_t decoded;
  if (cobs_.receive(byte, decoded) == CobsDecoder::Step::NOTHING) return Found::NOTHING;
  if (length_ == MAX_FRAME) {
    is_too_long_ = true;
    return Found::NOTHING;
  }
  if (length_ < sizeof buffer_) buffer_[length_] = decoded;
  ++length_;
  crc_.put(decoded);
  return Found::NOTHING;
}

OUT_OF_LINE bool CheckedReader::expire(uint32_t now_us) {
  if (!has_begun_ || !beginning_.is_too_old(now_us)) return false;
  restart();
  return true;
}

OUT_OF_LINE void CheckedReader::restart() {
  cobs_.restart();
  crc_ = Crc16();
  length_ = 0;
  has_begun_ = false;
  is_too_long_ = false;
}

}  // namespace raspilot
