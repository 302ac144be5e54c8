#include "loop_meter.h"

namespace raspilot {

namespace {

constexpr uint32_t SECOND_US = 1000000;
constexpr uint16_t GREATEST = 65535;

uint16_t bounded(uint32_t value) {
  return value < GREATEST ? static_cast<uint16_t>(value) : GREATEST;
}

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
  const uint32_t late_us = now_us - due_us;
  if (static_cast<int32_t>(late_us) <= 0) return;
  if (late_us > latest_us_) latest_us_ = bounded(late_us);
  if (late_us > MOST_LATE_US && overruns_ < GREATEST) ++overruns_;
}

void LoopMeter::end_second(uint32_t now_us) {
  // The seconds keep their own grid: a slot that begins a little early or late moves no second.
  second_us_ += SECOND_US;
  if (seconds_ < GREATEST) ++seconds_;
  period_us_ = bounded((now_us - first_slot_us_ + slots_ / 2) / slots_);
  first_slot_us_ = now_us;
  slots_ = 0;
  late_us_ = latest_us_;
  latest_us_ = 0;
}

}  // namespace raspilot
