#include "answers.h"

namespace raspilot {

namespace {

/** Time in steps of 65.5 ms, by a shift that costs an 8-bit CPU nothing. */
uint8_t stamp_of(uint32_t now_us) { return static_cast<uint8_t>(now_us >> 16); }

constexpr uint8_t SECOND = 17;

}  // namespace

constexpr uint8_t PendingAnswer::CONFIRM;
constexpr uint8_t PendingAnswer::ASK;

OUT_OF_LINE void Answers::push(uint8_t what, char type, uint8_t sequence) {
  if (!has_place()) return;
  waiting_[count_].what = what;
  waiting_[count_].type = static_cast<uint8_t>(type);
  waiting_[count_].sequence = sequence;
  ++count_;
}

void Answers::pop() {
  --count_;
  for (uint8_t at = 0; at < count_; ++at) waiting_[at] = waiting_[at + 1];
}

bool RefusalLimit::allows(char type, uint32_t now_us) {
  check(now_us);
  uint8_t& left = left_[static_cast<uint8_t>(type) % PLACES];
  if (left != 0) return false;
  left = SECOND;
  return true;
}

OUT_OF_LINE void RefusalLimit::check(uint32_t now_us) {
  const uint8_t passed = static_cast<uint8_t>(stamp_of(now_us) - checked_at_);
  checked_at_ = stamp_of(now_us);
  for (uint8_t& left : left_) left = left > passed ? static_cast<uint8_t>(left - passed) : 0;
}

}  // namespace raspilot
