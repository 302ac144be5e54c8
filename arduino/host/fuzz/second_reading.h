/**
 * A second implementation of docs/protocols.md 2.1 to 2.4 without the firmware's code: which bytes
 * are a frame, and which messages may leave. The fuzzer checks the firmware against it.
 */
#pragma once

#include <stdint.h>
#include <string.h>

#include <vector>

namespace raspilot {

typedef std::vector<uint8_t> Bytes;

constexpr int NO_SIZE = -1;
constexpr size_t MAX_ENCODED = 101;
constexpr uint32_t DROPPED_AFTER_US = 100000;

/** Payload of messages to the Arduino, bytes. */
inline int size_to_arduino(uint8_t type) {
  switch (type) {
    case 's': case 'a': case 'd': case 'm': case 'G': case 'c': return 0;
    case 'M': case 'v': case 'e': return 1;
    case 'V': return 2;
    case 'p': return 3;
    case 'u': case 'S': case 'R': return 10;
    case 'C': return 54;
    case 'g': return 72;
    default: return NO_SIZE;
  }
}

/** Payload of our firmware's messages, bytes. */
inline int size_from_arduino(uint8_t type) {
  switch (type) {
    case 'm': return 1;
    case 'K': return 2;
    case '!': return 3;
    case 'r': return 8;
    case 'i': return 13;
    case 'x': return 23;
    case 'O': return 26;
    case 'C': return 54;
    case 'G': return 72;
    default: return NO_SIZE;
  }
}

/** One frame without its closing zero: sequence, type and payload; empty when invalid. */
inline Bytes frame_in(const Bytes& encoded) {
  if (encoded.size() > MAX_ENCODED) return {};
  Bytes plain;
  for (size_t at = 0; at < encoded.size();) {
    const size_t code = encoded[at];
    if (code == 0 || at + code > encoded.size()) return {};
    plain.insert(plain.end(), encoded.begin() + static_cast<long>(at + 1),
                 encoded.begin() + static_cast<long>(at + code));
    at += code;
    if (code != 0xFF && at < encoded.size()) plain.push_back(0);
  }
  if (plain.size() < 4) return {};
  uint32_t crc = 0xFFFF;
  for (size_t at = 0; at + 2 < plain.size(); ++at) {
    crc ^= static_cast<uint32_t>(plain[at]) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000) ? crc << 1 ^ 0x11021 : crc << 1;
  }
  const uint32_t sent = static_cast<uint32_t>(plain[plain.size() - 2] << 8 | plain.back());
  if (crc != sent) return {};
  plain.resize(plain.size() - 2);
  return plain;
}

/** Whether a frame is one that the Arduino takes, by type and size. */
inline bool is_command(const Bytes& frame) {
  return frame.size() >= 2 && size_to_arduino(frame[1]) == static_cast<int>(frame.size()) - 2;
}

/** Follows the bytes to the Arduino, with the timeout that drops unfinished messages. */
class Listener {
 public:
  /** The frame that ends with this byte, or nothing. */
  Bytes take(uint8_t byte, uint32_t now_us) {
    if (!encoded_.empty() && now_us - first_us_ >= DROPPED_AFTER_US) encoded_.clear();
    if (byte == 0) {
      Bytes ended;
      ended.swap(encoded_);
      return frame_in(ended);
    }
    if (encoded_.empty()) first_us_ = now_us;
    encoded_.push_back(byte);
    return {};
  }

 private:
  Bytes encoded_;
  uint32_t first_us_ = 0;
};

}  // namespace raspilot
