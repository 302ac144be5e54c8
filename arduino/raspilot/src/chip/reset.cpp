#include "reset.h"

#include <avr/io.h>
#include <avr/wdt.h>

namespace raspilot {
namespace reset {

static constexpr uint32_t STOOD_STILL = 0x5A17B0D6;
/** Overflows without a slot after which the loop stands still: more than 65 ms. */
static constexpr uint8_t STILL_OVERFLOWS = 3;

#define KEPT __attribute__((section(".noinit")))

static uint8_t cause_at_start KEPT;
static volatile uint32_t marker KEPT;
static SavedStates states KEPT;
static volatile uint8_t overflows_without_slot;

/**
 * Starts the watchdog before anything else runs. After a watchdog reset it already runs, at its
 * shortest time, until this.
 */
extern "C" void raspilot_start_watchdog() __attribute__((naked, used, section(".init3")));
void raspilot_start_watchdog() {
  cause_at_start = MCUSR;
  MCUSR = 0;
  wdt_enable(WDTO_120MS);
}

uint8_t cause() {
  if (cause_at_start == 0 && marker == STOOD_STILL) return _BV(WDRF);
  return cause_at_start & (_BV(PORF) | _BV(EXTRF) | _BV(BORF) | _BV(WDRF));
}

bool restore(SavedState& state) {
  cause_at_start = cause();
  marker = 0;
  const bool is_kept = !(cause_at_start & _BV(PORF)) && states.read(state);
  if (is_kept && cause_at_start == _BV(WDRF)) return true;
  // Neither copy may arm after a second reset.
  states.reset();
  if (!is_kept) return false;
  state.authority = AuthorityState();
  state.authority.switch_position = SWITCH_UNKNOWN;
  states.write(state);
  return true;
}

void keep(const SavedState& state) { states.write(state); }

void feed() {
  // With interrupts off permanently the servos stand still, though the slots continue.
  if (SREG & _BV(SREG_I)) wdt_reset();
  overflows_without_slot = 0;
  if (marker != 0) marker = 0;
}

void on_overflow() {
  const uint8_t still = static_cast<uint8_t>(overflows_without_slot + 1);
  if (still < STILL_OVERFLOWS)
    overflows_without_slot = still;
  else
    marker = STOOD_STILL;
}

}  // namespace reset
}  // namespace raspilot
