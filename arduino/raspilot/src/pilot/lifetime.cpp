#include "lifetime.h"

namespace raspilot {

// One copy of each is smaller than all of them in their places.
OUT_OF_LINE uint16_t to_units(uint32_t now_us) { return static_cast<uint16_t>(now_us >> 10); }

OUT_OF_LINE void Stopwatch::pass(uint16_t units) {
  const uint16_t sum = static_cast<uint16_t>(units_ + units);
  units_ = sum < units ? 65535 : sum;
}

}  // namespace raspilot
