/** Short times with interrupts off, and the note that they leave for the receiver's stamps. */
#pragma once

#include <avr/interrupt.h>
#include <avr/io.h>

#include <stdint.h>

namespace raspilot {

/** Bits of GPIOR0, which takes one instruction to set, clear or test and no register. */
enum Note : uint8_t {
  /** The next stamp of the receiver's edges may be a few microseconds late. */
  NOTE_LATE = 0,
  /** The ring of stamps was full; edges are lost. */
  NOTE_LOST = 1,
  /** The next edge of this output is a rise. */
  NOTE_RISES_AILERONS = 2,
  NOTE_RISES_ELEVATOR = 3,
  NOTE_RISES_THROTTLE = 4,
  NOTE_RISES_RUDDER = 5
};

/**
 * Notes that an edge of the receiver came while its interrupt could not run. Every other interrupt
 * calls it last, so that a stamp is never wrong unnoticed.
 */
__attribute__((always_inline)) inline void note_waiting_edge() {
  if (PCIFR & _BV(PCIF0)) GPIOR0 |= _BV(NOTE_LATE);
  if (PCIFR & _BV(PCIF2)) GPIOR0 |= _BV(NOTE_LATE);
}

/** Interrupts are off while it lives: a few loads and stores, never a call. */
class InterruptsOff {
 public:
  __attribute__((always_inline)) InterruptsOff() : sreg_(SREG) { cli(); }
  __attribute__((always_inline)) ~InterruptsOff() {
    note_waiting_edge();
    SREG = sreg_;
    __asm__ __volatile__("" ::: "memory");
  }

 private:
  uint8_t sreg_;
};

}  // namespace raspilot
