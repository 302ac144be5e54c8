/** The whole portable firmware, run by a fuzzer and checked at each call against the rules. */
#pragma once

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/autopilot.h"
#include "fake_board.h"
#include "pilot_bench.h"
#include "frame_bytes.h"
#include "second_reading.h"

namespace raspilot {

/** Ends the run with a sentence about the broken rule. */
inline void never(bool has_happened, const char* what) {
  if (!has_happened) return;
  fprintf(stderr, "the firmware broke a rule: %s\n", what);
  abort();
}

class FuzzedBoard {
 public:
  explicit FuzzedBoard(uint32_t begin_us)
      : lines_(autopilot_.receiver, begin_us), begin_us_(begin_us) {
    fake_board().reset();
    autopilot_.begin(nullptr, RESET_POWER_ON, begin_us);
    autopilot_.link.open();
    check_rules("begin");
  }

  /** A byte arrives, and the time that it takes on the line passes. */
  void receive(uint8_t byte) {
    const bool was_armed = autopilot_.authority.is_armed();
    const Bytes frame = listener_.take(byte, clock_us());
    autopilot_.link.on_byte(byte, clock_us());
    const bool is_arming = is_command(frame) && frame[1] == 'a';
    never(!was_armed && autopilot_.authority.is_armed() && !is_arming,
          "armed by bytes other than an Arm Command");
    check_rules("a byte");
    pass(BYTE_US);
  }
  /** A checked frame arrives, valid except perhaps for type and size. */
  void receive_frame(uint8_t type, const Bytes& payload) {
    for (uint8_t byte : frame_bytes(sequence_++, static_cast<char>(type), payload.data(),
                                    static_cast<uint8_t>(payload.size()))) {
      receive(byte);
    }
  }
  /** Slots run as on the chip. */
  void run(uint32_t slots) {
    for (; slots != 0; --slots) pass(SLOT_US);
  }
  /** The firmware is not called for a while, as while a debugger holds it. */
  void stall(uint32_t us) {
    passed_us_ += us;
    next_slot_us_ += us;
    next_frame_us_ = passed_us_;
    fake_board().elapse(us);
  }
  void set_stick(uint8_t channel, uint16_t us) {
    if (channel == AUX2) follow_aux2(us);
    sticks_[channel] = us;
  }
  void switch_imu() { is_imu_on_ = !is_imu_on_; }
  void switch_receiver() { is_receiver_on_ = !is_receiver_on_; }

 private:
  static constexpr uint32_t SLOT_US = 2000;
  static constexpr uint32_t BYTE_US = 87;

  uint32_t clock_us() const { return begin_us_ + static_cast<uint32_t>(passed_us_); }

  void pass(uint32_t us) {
    passed_us_ += us;
    fake_board().elapse(us);
    while (next_slot_us_ <= passed_us_) {
      next_slot_us_ += SLOT_US;
      slot();
    }
  }
  void slot() {
    while (is_receiver_on_ && next_frame_us_ <= passed_us_) frame();
    lines_.slot(passed_us_);
    const ImuSample sample = sample_at_rest();
    const bool was_armed = autopilot_.authority.is_armed();
    autopilot_.meter.on_slot(clock_us(), clock_us());
    autopilot_.control(is_imu_on_ ? &sample : nullptr, clock_us());
    if (!was_armed && autopilot_.authority.is_armed()) {
      never(!has_aux2_edge_, "armed without an edge of AUX2");
      has_aux2_edge_ = false;
      was_aux2_low_ = false;
      follow_aux2(sticks_[AUX2]);
    }
    check_rules("control");
    for (int piece = 0; piece < 3; ++piece) {
      autopilot_.background(clock_us());
      check_rules("background");
    }
  }
  /** Level and at rest, with enough noise that the IMU does not count as frozen. */
  ImuSample sample_at_rest() {
    ImuSample sample = {};
    noise_ = noise_ * 1664525 + 1013904223;
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro[axis] = static_cast<int16_t>((noise_ >> (8 + 4 * axis) & 7) - 3);
    }
    sample.accel[2] = static_cast<int16_t>(ACCEL_PER_G + (noise_ >> 24 & 31));
    return sample;
  }
  /** A low and then a high, with the hysteresis about 1500 us and a little noise. */
  void follow_aux2(uint16_t us) {
    has_aux2_edge_ = has_aux2_edge_ || (was_aux2_low_ && us >= 1475);
    was_aux2_low_ = was_aux2_low_ || us < 1525;
  }
  void frame() {
    double at_us = static_cast<double>(next_frame_us_);
    for (uint8_t channel = 0; channel < INPUTS; ++channel) {
      lines_.pulse(at_us, channel, sticks_[channel]);
      at_us += sticks_[channel];
    }
    next_frame_us_ = passed_us_ + 20000;
  }

  /** After every call: counters, outputs, and the sent bytes. */
  void check_rules(const char* after) {
    const Link& link = autopilot_.link;
    never(link.dropped() < dropped_ || link.missing() < missing_, "a counter that runs backwards");
    dropped_ = link.dropped();
    missing_ = link.missing();
    for (Ticks pulse : autopilot_.controller.outputs().ticks) {
      never(pulse < us_to_ticks(800) || pulse > us_to_ticks(2200), "a pulse beyond every limit");
    }
    check_frames(fake_board().take_sent());
    if (fake_board().violations != 0) fprintf(stderr, "after %s: ", after);
    never(fake_board().violations != 0, "the board used against its contract");
  }
  /** Each call leaves whole frames behind, numbered without a gap. */
  void check_frames(const Bytes& sent) {
    never(!sent.empty() && sent.back() != 0, "half a frame");
    Bytes encoded;
    for (uint8_t byte : sent) {
      if (byte != 0) {
        encoded.push_back(byte);
        continue;
      }
      if (encoded.empty()) continue;
      const Bytes frame = frame_in(encoded);
      encoded.clear();
      never(frame.size() < 2, "an unreadable frame");
      never(size_from_arduino(frame[1]) != static_cast<int>(frame.size()) - 2,
            "a frame of unknown type or wrong size");
      never(frame[0] != expected_, "a frame out of sequence");
      ++expected_;
    }
  }

  Autopilot autopilot_;
  ReceiverLines lines_;
  Listener listener_;
  uint16_t sticks_[INPUTS] = {1500, 1500, 1000, 1500, 1000, 1000};
  uint32_t begin_us_;
  uint32_t noise_ = 1;
  uint64_t passed_us_ = 0;
  uint64_t next_slot_us_ = SLOT_US;
  uint64_t next_frame_us_ = 4000;
  uint16_t dropped_ = 0;
  uint16_t missing_ = 0;
  uint8_t sequence_ = 0;
  uint8_t expected_ = 0;
  bool is_receiver_on_ = true;
  bool is_imu_on_ = true;
  bool has_aux2_edge_ = false;
  bool was_aux2_low_ = true;
};

}  // namespace raspilot
