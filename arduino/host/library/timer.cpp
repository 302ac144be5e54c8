/** The chip's clock, and the time that the firmware's work takes. */
#include "chip/clock.h"
#include "chip/reset.h"
#include "hardware.h"

namespace host {

namespace {

constexpr Cycles TICK = PER_US / 2;
constexpr Cycles OVERFLOW = 65536 * TICK;
constexpr Cycles READING = 2 * PER_US;
/**
 * A piece of background work, or a byte of the line. It begins with now_us() and is over when the
 * time is next looked at.
 */
constexpr Cycles WORK = 35 * PER_US;
/** From there to the first slot, without the time for the content of the EEPROM. */
constexpr Cycles SETUP = 796 * PER_US;

Cycles start;
Cycles overflow_due = NEVER;
Cycles owed;

}  // namespace

namespace timer {

int64_t ticks_at(Cycles moment) { return (moment - start) / TICK; }

Cycles cycles_at(int64_t ticks) { return start + ticks * TICK; }

void run(Cycles moment) {
  while (overflow_due <= moment) {
    overflow_due += OVERFLOW;
    raspilot::reset::on_overflow();
  }
}

void reset() {
  overflow_due = NEVER;
  owed = 0;
}

}  // namespace timer
}  // namespace host

namespace raspilot {
namespace clock {

void begin() {
  host::start = host::now();
  host::overflow_due = host::start + host::OVERFLOW;
  host::pass(host::SETUP);
}

uint32_t now_us() {
  host::owed += host::WORK;
  return static_cast<uint32_t>((host::now() - host::start) / host::PER_US);
}

uint16_t ticks() {
  const host::Cycles owed = host::owed;
  host::owed = 0;
  if (owed) host::pass(owed);
  const uint16_t ticks = static_cast<uint16_t>(host::timer::ticks_at(host::now()));
  host::pass(host::READING);
  return ticks;
}

}  // namespace clock
}  // namespace raspilot
