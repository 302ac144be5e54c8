#include "clock.h"

#include "interrupts_off.h"
#include "reset.h"

namespace raspilot {
namespace clock {

static volatile uint32_t overflows;

void begin() {
  TIMSK1 = 0;
  TIMSK2 = 0;
  // Both prescalers are held until GTCCR is cleared (data sheet 17.3).
  GTCCR = _BV(TSM) | _BV(PSRASY) | _BV(PSRSYNC);
  TCCR1A = 0;
  TCCR1B = _BV(CS11);
  TCCR2A = 0;
  TCCR2B = _BV(CS21);
  TCNT1 = 0;
  TCNT2 = 0;
  TIFR1 = _BV(TOV1) | _BV(OCF1A) | _BV(OCF1B);
  TIFR2 = _BV(OCF2A) | _BV(OCF2B);
  GTCCR = 0;
  TIMSK1 = _BV(TOIE1);
}

uint32_t now_us() {
  uint16_t low;
  uint32_t high;
  bool is_pending;
  {
    InterruptsOff off;
    low = TCNT1;
    high = overflows;
    is_pending = TIFR1 & _BV(TOV1);
    note_waiting_edge();
  }
  // An overflow that was not served yet belongs to a count that has just restarted.
  if (is_pending && low < 0x8000) high++;
  return high << 15 | low >> 1;
}

uint16_t ticks() {
  InterruptsOff off;
  return TCNT1;
}

}  // namespace clock

ISR(TIMER1_OVF_vect) {
  clock::overflows = clock::overflows + 1;
  reset::on_overflow();
  note_end_of_interrupt();
}

}  // namespace raspilot
