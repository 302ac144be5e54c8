/** A Link on a freshly powered board, and the bytes received by a Raspberry Pi at its other end. */
#pragma once

#include <string>
#include <vector>

#include "core/autopilot.h"
#include "fake_board.h"
#include "frame_bytes.h"

namespace raspilot {

typedef std::vector<uint8_t> Bytes;

/** One message of the firmware in checked framing. */
struct Message {
  char type;
  Bytes payload;
};

class LinkBench {
 public:
  explicit LinkBench(uint32_t begin_us = 1000000) : now_us(begin_us) {
    fake_board().reset();
    autopilot.begin(nullptr, RESET_POWER_ON, now_us);
    autopilot.link.open();
  }

  void receive(const Bytes& bytes) {
    for (uint8_t byte : bytes) autopilot.link.on_byte(byte, now_us);
  }
  void receive(const std::string& bytes) { receive(Bytes(bytes.begin(), bytes.end())); }
  void send(char type, const Bytes& payload = {}) { receive(frame_of(sequence++, type, payload)); }
  /** Time passes with all the work of a slot's spare time, in steps of 500 us. */
  void run_ms(uint32_t ms) {
    for (uint32_t step = 0; step < ms * 2; ++step) {
      now_us += 500;
      fake_board().elapse(500);
      autopilot.link.check(now_us);
      autopilot.link.background(now_us);
    }
  }
  /** Everything sent since the last call, as bytes. */
  Bytes take_raw() { return fake_board().take_sent(); }
  /** Everything sent since the last call, as messages; an invalid frame fails `is_clean`. */
  std::vector<Message> take() {
    std::vector<Message> messages;
    for (uint8_t byte : take_raw()) {
      const CheckedReader::Found found = reader_.receive(byte, 0);
      if (found == CheckedReader::Found::BROKEN) is_clean = false;
      if (found != CheckedReader::Found::FRAME) continue;
      if (reader_.sequence() != expected_++) is_clean = false;
      const uint8_t* const first = reader_.payload();
      messages.push_back({reader_.type(), Bytes(first, first + reader_.payload_size())});
    }
    return messages;
  }
  std::string take_types() {
    std::string types;
    for (const Message& message : take()) types += message.type;
    return types;
  }
  /** The line takes no byte until `drain`. */
  void clog() { fake_board().queued = SERIAL_CAPACITY; }
  void drain() { fake_board().queued = 0; }

  static Bytes frame_of(uint8_t sequence, char type, const Bytes& payload) {
    return frame_bytes(sequence, type, payload.data(), static_cast<uint8_t>(payload.size()));
  }

  Autopilot autopilot;
  uint32_t now_us;
  uint8_t sequence = 0;
  bool is_clean = true;

 private:
  CheckedReader reader_;
  uint8_t expected_ = 0;
};

}  // namespace raspilot
