#include "answers.h"

namespace raspilot {

namespace {

/** Time in steps of 65.5 ms, by a shift that costs an 8-bit CPU nothing. */
uint8_t stamp_of(uint32_t now_us) { return static_cast<uint8_t>(now_us >> 16); }

constexpr uint8_t SECOND = 16;

/** Moves `count` bytes down to `to` from `step` bytes above it. */
OUT_OF_LINE void move_down(void* to, uint8_t step, uint8_t count) {
  uint8_t* at = static_cast<uint8_t*>(to);
  for (; count != 0; --count, ++at) *at = at[step];
}

}  // namespace

constexpr uint8_t PendingAnswer::CONFIRM;
constexpr uint8_t PendingAnswer::ASK;

void Answers::push(uint8_t what, char type, uint8_t sequence) {
  if (!has_place()) return;
  waiting_[count_].what = what;
  waiting_[count_].type = static_cast<uint8_t>(type);
  waiting_[count_].sequence = sequence;
  ++count_;
}

void Answers::pop() {
  --count_;
  move_down(waiting_, sizeof *waiting_, static_cast<uint8_t>(count_ * sizeof *waiting_));
}

bool RefusalLimit::allows(char type, uint32_t now_us) {
  check(now_us);
  for (uint8_t index = 0; index < count_; ++index) {
    if (refused_[index].type == type) return false;
  }
  if (count_ == CAPACITY) discard_oldest();
  refused_[count_].type = type;
  refused_[count_].stamp = stamp_of(now_us);
  ++count_;
  return true;
}

void RefusalLimit::check(uint32_t now_us) {
  // The oldest comes first, so that the rest is younger.
  while (count_ != 0 && static_cast<uint8_t>(stamp_of(now_us) - refused_[0].stamp) > SECOND) {
    discard_oldest();
  }
}

void RefusalLimit::discard_oldest() {
  --count_;
  move_down(refused_, sizeof *refused_, static_cast<uint8_t>(count_ * sizeof *refused_));
}

}  // namespace raspilot
