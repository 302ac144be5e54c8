/** Short times with interrupts off, and the note that they leave for the receiver's stamps. */
#pragma once

#include <avr/interrupt.h>
#include <avr/io.h>

#include <stdint.h>

namespace raspilot {

/** Bits of GPIOR0, which takes one instruction to set, clear or test and no register. */
enum Note : uint8_t {
  /** The next stamp of the receiver's edges may be some microseconds late. */
  NOTE_LATE = 0,
  /** The ring of stamps was full; edges are lost. */
  NOTE_LOST = 1,
  /** The next edge of this output is a rise. */
  NOTE_RISES_THROTTLE = 4,
  NOTE_RISES_RUDDER = 5
};

/** Time of an interrupt from its note to its end, and of the next from there to its stamp. */
constexpr uint8_t AFTER_INTERRUPT_TICKS = 8;

/**
 * Every interrupt's last word: when it ended, on Timer2, which is Timer1's low byte. An edge of the
 * receiver that is stamped less than AFTER_INTERRUPT_TICKS later may have waited for it.
 */
__attribute__((always_inline)) inline void note_end_of_interrupt() { GPIOR1 = TCNT2; }

/** Notes an edge that waits for its interrupt, at the end of a long time with interrupts off. */
__attribute__((always_inline)) inline void note_waiting_edge() {
  if (PCIFR & (_BV(PCIF0) | _BV(PCIF2))) GPIOR0 |= _BV(NOTE_LATE);
}

/**
 * Interrupts are off while it lives: a few loads and stores, never a call. Where that takes more
 * than a microsecond, note_waiting_edge() comes last.
 */
class InterruptsOff {
 public:
  __attribute__((always_inline)) InterruptsOff() : sreg_(SREG) { cli(); }
  __attribute__((always_inline)) ~InterruptsOff() {
    SREG = sreg_;
    __asm__ __volatile__("" ::: "memory");
  }

 private:
  uint8_t sreg_;
};

}  // namespace raspilot
