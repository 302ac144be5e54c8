#include "lifetime.h"

namespace raspilot {

void Lifetime::pass(uint16_t units) {
  left_ = left_ > units ? static_cast<uint16_t>(left_ - units) : 0;
}

void Stopwatch::pass(uint16_t units) {
  const uint16_t sum = static_cast<uint16_t>(units_ + units);
  units_ = sum < units ? 65535 : sum;
}

}  // namespace raspilot
