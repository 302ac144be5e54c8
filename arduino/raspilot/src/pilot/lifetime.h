/**
 * Durations of at most 67 s that never wrap, advanced by their owners. They are counted in units
 * of 1024 us, because a microcontroller divides by a shift.
 */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"

namespace raspilot {

/** The clock in units. */
uint16_t to_units(uint32_t now_us);
/** Units that last at least `ms`, and at most 2 units more. */
constexpr uint16_t units_at_least(uint16_t ms) {
  return static_cast<uint16_t>(ms * 1000UL / 1024 + 2);
}
/** Units that last at most `ms`, and at most 3 units less. */
constexpr uint16_t units_at_most(uint16_t ms) {
  return static_cast<uint16_t>(ms * 1000UL / 1024 - 1);
}

/** How long something holds still. */
class Lifetime {
 public:
  void start(uint16_t units) { left_ = units; }
  void end() { left_ = 0; }
  void pass(uint16_t units) { left_ = left_ > units ? static_cast<uint16_t>(left_ - units) : 0; }
  bool is_running() const { return left_ != 0; }

 private:
  uint16_t left_ ZEROED;
};

/** How long something has lasted, units; stays at 65535. */
class Stopwatch {
 public:
  void start() { units_ = 0; }
  void pass(uint16_t units);
  uint16_t units() const { return units_; }

 private:
  uint16_t units_ ZEROED;
};

}  // namespace raspilot
