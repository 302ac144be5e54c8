/** Answers that wait for room on the line, and the rate limit of refusals. */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"
#include "../core/types.h"

namespace raspilot {

/** One answer to send: a confirmation, a refusal, or a Command that sends its own. */
struct PendingAnswer {
  /** `K`, ASK for a handler that sends its own answer, otherwise a Reason. */
  uint8_t what;
  uint8_t type;
  uint8_t sequence;

  static constexpr uint8_t CONFIRM = 'K';
  static constexpr uint8_t ASK = 255;
};

/** The oldest first. Who needs an answer and finds no place is not carried out. */
class Answers {
 public:
  bool has_place() const { return count_ < CAPACITY; }
  bool is_empty() const { return count_ == 0; }
  void push(uint8_t what, char type, uint8_t sequence);
  PendingAnswer& front() { return waiting_[0]; }
  void pop();

 private:
  static constexpr uint8_t CAPACITY = 4;

  PendingAnswer waiting_[CAPACITY];
  uint8_t count_ ZEROED;
};

/**
 * Limits refusals of each type to one a second (docs/protocols.md 2.5). Types that end in the same
 * three bits share it; no two streams do.
 */
class RefusalLimit {
 public:
  /** True, and the second begins, when the type was not refused within the last one. */
  bool allows(char type, uint32_t now_us);
  /** Lets the time pass; call at least every ten seconds. */
  void check(uint32_t now_us);

 private:
  static constexpr uint8_t PLACES = 8;

  /** The rest of each second, in steps of 65.5 ms. */
  uint8_t left_[PLACES] ZEROED;
  uint8_t checked_at_ ZEROED;
};

}  // namespace raspilot
