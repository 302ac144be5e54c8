/** Times of at most 65 s in milliseconds, moved on by whoever owns them: nothing in them wraps. */
#pragma once

#include <stdint.h>

namespace raspilot {

/** How long something holds still. */
class Lifetime {
 public:
  void start(uint16_t ms) { left_ms_ = ms; }
  void end() { left_ms_ = 0; }
  void pass(uint16_t ms) { left_ms_ = left_ms_ > ms ? static_cast<uint16_t>(left_ms_ - ms) : 0; }
  bool lives() const { return left_ms_ != 0; }

 private:
  uint16_t left_ms_ = 0;
};

/** How long something has lasted; stays at 65535. */
class Stopwatch {
 public:
  void start(uint16_t ms = 0) { ms_ = ms; }
  void pass(uint16_t ms) {
    const uint16_t sum = static_cast<uint16_t>(ms_ + ms);
    ms_ = sum < ms ? 65535 : sum;
  }
  uint16_t ms() const { return ms_; }

 private:
  uint16_t ms_ = 0;
};

}  // namespace raspilot
