#include "servos.h"

#include "clock.h"
#include "servo_edges.h"

namespace raspilot {

/** Pulse, up to one slot until it is read, and its control fit in. */
static constexpr uint16_t LATENCY_TICKS = 10000;
#ifdef RASPILOT_PROTOTYPE_BOARD
/** Edges made by interrupts must not coincide, nor with a round of Timer2: 20 us apart. */
static constexpr uint16_t STAGGER_TICKS = 40;
#else
static constexpr uint16_t STAGGER_TICKS = 0;
#endif
static constexpr uint16_t FREE_PERIOD_TICKS = 40000;
static constexpr uint16_t MIN_PERIOD_TICKS = 12000;
/** A rise is planned when it is nearer than this, a slot and how late the next may be. */
static constexpr int16_t LEAD_TICKS = 6000;
static constexpr int16_t MIN_LEAD_TICKS = 600;
/** 26 ms without a rise: the receiver is silent, as its frames last 22 ms at most. */
static constexpr uint8_t SILENT_SLOTS = 13;
/** 20 ms of a free frame less a lead: no rise is planned before. */
static constexpr uint8_t FREE_SLOTS = 6;

void Servos::begin() {
  for (Plan& plan : plans_) {
    plan.slots = SILENT_SLOTS;
    plan.is_free = true;
  }
  servo_edges::begin();
}

void Servos::set(const Outputs& outputs) {
  for (uint8_t i = 0; i < OUTPUTS; i++)
    servo_edges::set_width(static_cast<Channel>(i), outputs.ticks[i]);
}

void Servos::plan(PwmReader& receiver) {
  const uint16_t now = clock::ticks();
  for (uint8_t i = 0; i < OUTPUTS; i++) {
    const Channel channel = static_cast<Channel>(i);
    uint16_t stamp;
    if (receiver.take_rise(channel, stamp)) {
      plans_[i].next = stamp + LATENCY_TICKS + i * STAGGER_TICKS;
      plans_[i].has_next = true;
      plans_[i].is_free = false;
    }
    plan_channel(channel, now);
  }
}

void Servos::plan_channel(Channel channel, uint16_t now) {
  Plan& plan = plans_[channel];
  if (plan.slots < 255) plan.slots++;
  if (servo_edges::is_busy(channel)) return;
  uint16_t rise = plan.next;
  if (!plan.has_next) {
    if (plan.slots >= SILENT_SLOTS) {
      plan.is_free = true;
      rise = now + MIN_LEAD_TICKS + channel * STAGGER_TICKS;
    } else if (plan.is_free && plan.slots >= FREE_SLOTS) {
      rise = plan.rise + FREE_PERIOD_TICKS;
    } else {
      return;
    }
  }
  const int16_t left = static_cast<int16_t>(rise - now);
  if (left > LEAD_TICKS) return;
  // A late slot has made this one late too; better late than not at all.
  if (left < MIN_LEAD_TICKS) rise = now + MIN_LEAD_TICKS;
  plan.has_next = false;
  if (plan.slots < SILENT_SLOTS && static_cast<uint16_t>(rise - plan.rise) < MIN_PERIOD_TICKS)
    return;
  servo_edges::plan(channel, rise);
  plan.rise = rise;
  plan.slots = 0;
}

}  // namespace raspilot
