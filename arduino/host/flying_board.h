/** The whole portable firmware with a receiver, an IMU and a Raspberry Pi around it, slot by slot. */
#pragma once

#include <stdint.h>

#include <functional>
#include <string>
#include <vector>

#include "core/autopilot.h"
#include "fake_board.h"
#include "moving_imu.h"
#include "pilot_bench.h"
#include "protocol/checked_reader.h"
#include "frame_bytes.h"

namespace raspilot {

/** One frame that the firmware sent. */
struct SentFrame {
  char type;
  uint32_t at_us;
  std::vector<uint8_t> payload;
};

/** Sticks are us, time is ms; the fake board's EEPROM outlives it as a real one does. */
class FlyingBoard {
 public:
  explicit FlyingBoard(const SavedState* restored = nullptr, uint8_t cause = RESET_POWER_ON)
      : lines(autopilot.receiver, 0) {
    fake_board().power_on();
    autopilot.begin(restored, cause, 0);
    autopilot.link.open();
  }

  void run(uint32_t ms) {
    for (uint32_t passed = 0; passed < ms; passed += 2) slot();
  }
  bool run_until(const std::function<bool()>& is_so, uint32_t ms) {
    for (uint32_t passed = 0; passed < ms && !is_so(); passed += 2) slot();
    return is_so();
  }
  /** Switch low to high after a low that counts: arms and disarms. */
  void flick_aux2() {
    sticks[AUX2] = 1000;
    run(400);
    sticks[AUX2] = 2000;
    run(400);
  }
  /** A receiver and an IMU that work, throttle low, AUX2 low, nothing to calibrate. */
  void wake() {
    run_until([this] { return autopilot.authority.has_receiver(); }, 500);
    run_until([this] { return autopilot.attitude.is_valid(); }, 3000);
    run_until([this] { return !autopilot.attitude.is_calibrating(); }, 12000);
  }
  void send(char type, const std::vector<uint8_t>& payload = {}) {
    for (uint8_t byte : frame_bytes(sequence++, type, payload.data(),
                                    static_cast<uint8_t>(payload.size()))) {
      autopilot.link.on_byte(byte, now_us());
    }
  }
  uint16_t output_us(Channel channel) const {
    return ticks_to_us(autopilot.controller.outputs().ticks[channel]);
  }
  /** The newest frame of a type since the last call; empty payload and type 0 without one. */
  SentFrame take(char type) {
    SentFrame found = {0, 0, {}};
    for (const SentFrame& frame : frames) {
      if (frame.type == type) found = frame;
    }
    frames.clear();
    return found;
  }
  uint32_t now_us() const { return static_cast<uint32_t>(now_us_); }

  Autopilot autopilot;
  ReceiverLines lines;
  MovingImu imu;
  uint16_t sticks[INPUTS] = {1500, 1500, 1000, 1500, 1000, 1000};
  bool is_receiver_on = true;
  bool is_imu_on = true;
  uint8_t sequence = 0;
  std::vector<SentFrame> frames;

 private:

  void slot() {
    autopilot.meter.on_slot(now_us(), now_us());
    while (is_receiver_on && next_frame_us_ <= now_us_) frame();
    lines.slot(now_us_);
    imu.turn(imu.rate_deg_s[0], imu.rate_deg_s[1], imu.rate_deg_s[2]);
    const ImuSample sample = imu.sample();
    autopilot.control(is_imu_on ? &sample : nullptr, now_us());
    for (uint32_t piece_us = 900; piece_us < 1400; piece_us += 100) {
      autopilot.background(static_cast<uint32_t>(now_us_ + piece_us));
    }
    now_us_ += SLOT_US;
    fake_board().elapse(SLOT_US);
    for (uint8_t byte : fake_board().take_sent()) receive(byte);
  }
  void frame() {
    double at_us = static_cast<double>(next_frame_us_);
    for (uint8_t channel = 0; channel < INPUTS; ++channel) {
      lines.pulse(at_us, channel, sticks[channel]);
      at_us += sticks[channel];
    }
    next_frame_us_ = now_us_ + 20000;
  }
  void receive(uint8_t byte) {
    if (reader_.receive(byte, now_us()) != CheckedReader::Found::FRAME) return;
    const uint8_t* const first = reader_.payload();
    const std::vector<uint8_t> payload(first, first + reader_.payload_size());
    frames.push_back(SentFrame{reader_.type(), now_us(), payload});
  }

  CheckedReader reader_;
  uint64_t now_us_ = 0;
  uint64_t next_frame_us_ = 4000;
};

}  // namespace raspilot
