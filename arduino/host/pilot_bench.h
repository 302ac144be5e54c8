/** A receiver, its reader and Authority in slots of 2 ms, as the chip runs them. */
#pragma once

#include <stdint.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "pilot/authority.h"
#include "pilot/pwm_reader.h"

namespace raspilot {

/** One edge on one input, at a moment of 0.5 us since the bench began. */
struct LineEdge {
  uint64_t tick;
  uint8_t channel;
  bool is_high;
  bool is_late;
};

/** Six lines with edges; the reader gets them stamped, those of one moment in one snapshot. */
class ReceiverLines {
 public:
  ReceiverLines(PwmReader& reader, uint32_t begin_us) : reader_(reader), begin_us_(begin_us) {}

  void edge(uint64_t tick, uint8_t channel, bool is_high, bool is_late = false) {
    edges_.push_back(LineEdge{tick, channel, is_high, is_late});
    is_sorted_ = false;
  }
  void pulse(double at_us, uint8_t channel, double width_us, bool is_late = false) {
    edge(static_cast<uint64_t>(at_us * 2 + 0.5), channel, true, is_late);
    edge(static_cast<uint64_t>((at_us + width_us) * 2 + 0.5), channel, false, is_late);
  }
  /** Hands over the edges before `now_us` since the bench began, then lets the reader check. */
  void slot(uint64_t now_us) {
    if (!is_sorted_) {
      edges_.erase(edges_.begin(), edges_.begin() + static_cast<long>(taken_));
      std::stable_sort(edges_.begin(), edges_.end(),
                       [](const LineEdge& a, const LineEdge& b) { return a.tick < b.tick; });
      taken_ = 0;
      is_sorted_ = true;
    }
    const uint32_t clock_us = begin_us_ + static_cast<uint32_t>(now_us);
    while (taken_ < edges_.size() && edges_[taken_].tick <= now_us * 2) {
      const uint64_t tick = edges_[taken_].tick;
      bool is_late = false;
      for (; taken_ < edges_.size() && edges_[taken_].tick == tick; ++taken_) {
        const uint8_t bit = static_cast<uint8_t>(1 << edges_[taken_].channel);
        levels = static_cast<uint8_t>(edges_[taken_].is_high ? levels | bit : levels & ~bit);
        is_late = is_late || edges_[taken_].is_late;
      }
      const uint16_t stamp = static_cast<uint16_t>(begin_us_ * 2 + tick);
      reader_.on_edge(stamp, levels, is_late, clock_us);
    }
    reader_.check(clock_us);
  }
  uint32_t clock_us(uint64_t now_us) const { return begin_us_ + static_cast<uint32_t>(now_us); }

  uint8_t levels = 0;

 private:
  PwmReader& reader_;
  uint32_t begin_us_;
  std::vector<LineEdge> edges_;
  size_t taken_ = 0;
  bool is_sorted_ = true;
};

/** The pilot's side of the aircraft; sticks are us, time is in ms. */
class PilotBench {
 public:
  explicit PilotBench(uint32_t begin_us = 0)
      : calibration(DEFAULT_CALIBRATION),
        profile(DEFAULT_PROFILE),
        reader(calibration),
        authority(profile, reader),
        lines(reader, begin_us) {}

  /** Runs whole slots; frames of six pulses, one after the other, every `frame_us`. */
  void run(uint32_t ms) {
    const uint64_t end_us = now_us + uint64_t{ms} * 1000;
    while (now_us + 2000 <= end_us) {
      now_us += 2000;
      while (next_frame_us <= now_us) frame();
      lines.slot(now_us);
      authority.update(is_imu_valid, is_calibrating, is_profile_broken, clock_us());
      if (on_slot) on_slot();
    }
  }
  void move(Channel channel, uint16_t width_us, uint32_t ms) {
    sticks[channel] = width_us;
    run(ms);
  }
  /** Runs slots until it is so, at most `ms`; returns the ms that it took. */
  uint32_t run_until(const std::function<bool()>& is_so, uint32_t ms) {
    for (uint32_t passed = 0; passed < ms; passed += 2) {
      if (is_so()) return passed;
      run(2);
    }
    return ms;
  }
  uint32_t clock_us() const { return lines.clock_us(now_us); }

  Ticks throttle_us() const { return static_cast<Ticks>(authority.throttle() / 2); }
  /** Switch low to high after a low that counts: arms. */
  void flick_aux2() {
    move(AUX2, 1000, 400);
    move(AUX2, 2000, 400);
  }
  /** A valid receiver, throttle low, the switch at a position. */
  void fly(uint16_t aux1_us, bool is_armed = true) {
    move(AUX1, aux1_us, 100);
    if (is_armed) flick_aux2();
  }
  Reason output(uint16_t ailerons, uint16_t throttle, uint32_t age_us = 20000) {
    const uint16_t pulses[OUTPUTS] = {ailerons, 1500, throttle, 1500};
    return authority.accept_outputs(pulses, age_us);
  }
  Reason demand(int16_t roll_cdeg, uint16_t throttle, uint16_t lifetime_ms = 250) {
    return authority.accept_setpoint(Setpoint{roll_cdeg, 0, 0, throttle}, lifetime_ms);
  }
  Reason return_by(int16_t roll_cdeg, uint16_t throttle, uint16_t lifetime_ms = 250) {
    return authority.accept_return(Setpoint{roll_cdeg, 0, 0, throttle}, lifetime_ms);
  }
  Reason ask(char letter) { return authority.request_mode(letter); }
  Reason arm() { return authority.arm(); }
  Reason disarm() { return authority.disarm(); }

  Calibration calibration;
  Profile profile;
  PwmReader reader;
  Authority authority;
  ReceiverLines lines;
  std::function<void()> on_slot;
  uint16_t sticks[INPUTS] = {1500, 1500, 1000, 1500, 1000, 1000};
  bool is_on = true;
  bool is_imu_valid = true;
  bool is_calibrating = false;
  bool is_profile_broken = false;
  uint64_t now_us = 0;
  uint64_t next_frame_us = 4000;
  uint32_t frame_us = 20000;

 private:
  void frame() {
    double at_us = static_cast<double>(next_frame_us);
    for (uint8_t i = 0; i < INPUTS && is_on; ++i) {
      lines.pulse(at_us, i, sticks[i]);
      at_us += sticks[i];
    }
    next_frame_us += frame_us;
  }
};

/** One that flies from the beginning, with the switch at a position. */
struct FlyingBench : PilotBench {
  explicit FlyingBench(uint16_t aux1_us, bool is_armed = true) { fly(aux1_us, is_armed); }
};

}  // namespace raspilot
