#include "link_script.h"

#include <stdio.h>
#include <stdlib.h>

#include <vector>

#include "core/autopilot.h"
#include "fake_board.h"
#include "pilot_bench.h"
#include "frame_bytes.h"

namespace raspilot {

namespace {

void demand(bool is_so, const char* rule) {
  if (is_so) return;
  fprintf(stderr, "broken: %s\n", rule);
  abort();
}

/** CRC-16/CCITT-FALSE bit by bit: another way than the firmware's. */
uint16_t slow_crc(const uint8_t* bytes, size_t size) {
  uint16_t crc = 0xFFFF;
  for (size_t at = 0; at < size; ++at) {
    crc = static_cast<uint16_t>(crc ^ bytes[at] << 8);
    for (int bit = 0; bit < 8; ++bit) {
      crc = static_cast<uint16_t>((crc & 0x8000) != 0 ? crc << 1 ^ 0x1021 : crc << 1);
    }
  }
  return crc;
}

/** Sees in the bytes of the line whether they may ever have been a whole Arm Command. */
class ArmWatcher {
 public:
  void take(uint8_t byte) {
    if (byte != 0) {
      newest_.push_back(byte);
      return;
    }
    if (newest_.size() >= FRAME && is_arm(newest_.data() + newest_.size() - FRAME)) has_seen = true;
    newest_.clear();
  }
  bool has_seen = false;

 private:
  static constexpr size_t FRAME = 5;

  static bool is_arm(const uint8_t* encoded) {
    uint8_t plain[FRAME];
    size_t length = 0;
    for (size_t at = 0; at < FRAME;) {
      const size_t code = encoded[at];
      if (at + code > FRAME) return false;
      for (size_t next = at + 1; next < at + code; ++next) plain[length++] = encoded[next];
      at += code;
      if (at < FRAME) plain[length++] = 0;
    }
    return length == 4 && plain[1] == 'a' && slow_crc(plain, 4) == 0;
  }

  std::vector<uint8_t> newest_;
};

class Conversation {
 public:
  Conversation() : lines_(autopilot_.receiver, 0) {
    fake_board().reset();
    autopilot_.begin(nullptr, RESET_POWER_ON, 0);
    autopilot_.link.open();
    slots(300);
  }

  ScriptEnd play(const uint8_t* script, size_t size) {
    const uint8_t* const end = script + size;
    while (script != end) {
      const uint8_t record = *script++;
      const size_t left = static_cast<size_t>(end - script);
      if (record < 0x80) {
        const size_t count = std::min<size_t>(record, left);
        for (size_t at = 0; at < count; ++at) receive(*script++);
      } else if (record < 0xC0) {
        slots(record - 0x80U + 1);
      } else {
        script = frame(script, left);
      }
      check_rules();
    }
    const ScriptEnd result = {autopilot_.authority.is_armed()};
    still_answers();
    return result;
  }

 private:
  void receive(uint8_t byte) {
    watcher_.take(byte);
    autopilot_.link.on_byte(byte, now_us());
  }

  /** A zero first, so that no earlier byte can corrupt the frame. */
  const uint8_t* frame(const uint8_t* script, size_t left) {
    if (left == 0) return script;
    const char type = static_cast<char>(*script++);
    CommandDefinition command;
    const bool is_known = find_command(type, command);
    uint8_t payload[MAX_COMMAND] = {};
    const size_t size = std::min<size_t>(is_known ? command.size : 3, left - 1);
    std::copy(script, script + size, payload);
    send(type, payload, is_known ? command.size : 3);
    return script + size;
  }

  void send(char type, const uint8_t* payload, uint8_t size) {
    receive(0);
    for (uint8_t byte : frame_bytes(sequence_++, type, payload, size)) receive(byte);
  }

  void slots(uint32_t count) {
    for (; count != 0; --count) {
      slot_us_ += SLOT_US;
      // Throttle low, AUX2 high from the first pulse on: no edge of it, so only `a` arms.
      if (slot_us_ % 20000 == 0) {
        const uint16_t pulses_us[INPUTS] = {1500, 1500, 1000, 1500, 2000, 2000};
        for (uint8_t channel = 0; channel < INPUTS; ++channel) {
          lines_.pulse(static_cast<double>(slot_us_), channel, pulses_us[channel]);
        }
      }
      lines_.slot(slot_us_);
      autopilot_.authority.update(true, autopilot_.receiver.is_learning(), false, now_us());
      fake_board().elapse(SLOT_US);
      for (int piece = 0; piece < 4; ++piece) autopilot_.background(now_us());
      check_rules();
    }
  }

  /** Invariants at every moment. */
  void check_rules() {
    const Link& link = autopilot_.link;
    const bool is_armed = autopilot_.authority.is_armed();
    demand(!is_armed || watcher_.has_seen, "nothing but a valid Arm Command arms");
    demand(fake_board().violations == 0, "the line gets no byte without room, EEPROM none early");
    demand(link.dropped() >= dropped_ && link.missing() >= missing_, "counters only rise");
    demand(are_gains_good(), "gains are always in range");
    dropped_ = link.dropped();
    missing_ = link.missing();
    listen();
  }

  bool are_gains_good() const {
    uint8_t wire[GAINS_SIZE];
    write_gains(autopilot_.settings.gains, wire);
    Gains gains;
    return read_gains(wire, gains);
  }

  /** Everything sent is frames, whole and in sequence. */
  void listen() {
    for (uint8_t byte : fake_board().take_sent()) {
      const CheckedReader::Found found = reader_.receive(byte, 0);
      demand(found != CheckedReader::Found::BROKEN, "every frame sent is whole");
      if (found != CheckedReader::Found::FRAME) continue;
      demand(reader_.sequence() == expected_++, "frames are sent in sequence");
      if (reader_.type() == 'm') ++modes_told_;
    }
  }

  /** After any input and 100 ms of silence a request is answered. */
  void still_answers() {
    slots(150);
    const unsigned reported_before = modes_told_;
    send('m', nullptr, 0);
    slots(60);
    demand(modes_told_ == reported_before + 1, "it still answers");
  }

  uint32_t now_us() const { return static_cast<uint32_t>(slot_us_); }

  Autopilot autopilot_;
  ReceiverLines lines_;
  CheckedReader reader_;
  ArmWatcher watcher_;
  uint64_t slot_us_ = 0;
  uint16_t dropped_ = 0;
  uint16_t missing_ = 0;
  unsigned modes_told_ = 0;
  uint8_t sequence_ = 0;
  uint8_t expected_ = 0;
};

}  // namespace

ScriptEnd play(const uint8_t* script, size_t size) { return Conversation().play(script, size); }

}  // namespace raspilot
