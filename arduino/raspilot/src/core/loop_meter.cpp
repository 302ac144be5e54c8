#include "loop_meter.h"

namespace raspilot {

namespace {

constexpr uint32_t SECOND_US = 1000000;
constexpr uint16_t MAX = 65535;

}  // namespace

void LoopMeter::on_slot(uint32_t due_us, uint32_t now_us) {
  if (!has_begun_) {
    has_begun_ = true;
    second_us_ = now_us;
    first_slot_us_ = now_us;
  } else if (now_us - second_us_ >= SECOND_US) {
    end_second(now_us);
  }
  ++slots_;
  const int32_t late_us = static_cast<int32_t>(now_us - due_us);
  if (late_us <= latest_us_) return;
  latest_us_ = late_us < MAX ? static_cast<uint16_t>(late_us) : MAX;
}

void LoopMeter::end_second(uint32_t now_us) {
  // The seconds keep their own grid: a slot that begins a little early or late moves no second.
  second_us_ += SECOND_US;
  if (seconds_ != MAX) ++seconds_;
  // The watchdog ends a slot of 120 ms, so that there are eight and more in a second.
  period_us_ = static_cast<uint16_t>((now_us - first_slot_us_) / slots_);
  first_slot_us_ = now_us;
  slots_ = 0;
  late_us_ = latest_us_;
  latest_us_ = 0;
}

}  // namespace raspilot
