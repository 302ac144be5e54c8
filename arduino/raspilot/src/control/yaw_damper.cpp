#include "yaw_damper.h"

#include "fixed_point.h"

namespace raspilot {

namespace {
constexpr uint8_t WASHOUT_SHIFT = 10;  // slots of 2000 us: 2.05 s
}

void YawDamper::reset() {
  loop_.reset();
  has_steady_ = false;
}

Ticks YawDamper::damp(int16_t wanted_16, int16_t rate_16) {
  if (!has_steady_) {
    has_steady_ = true;
    steady_ = rate_16 * static_cast<int32_t>(1 << WASHOUT_SHIFT);
  }
  const int16_t steady_16 = static_cast<int16_t>(rounded(steady_, WASHOUT_SHIFT));
  steady_ += static_cast<int32_t>(rate_16) - steady_16;
  return loop_.hold(wanted_16, difference_of(rate_16, steady_16));
}

}  // namespace raspilot
