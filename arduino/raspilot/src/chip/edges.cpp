#include "edges.h"

#include "interrupts_off.h"
#include "pins.h"

namespace raspilot {
namespace edges {

/** In a slot six inputs make twelve edges at most, some of which occur twice. */
static constexpr uint8_t STAMPS = 18;
static constexpr uint8_t STAMP_SIZE = 3;
static constexpr uint8_t RING_SIZE = STAMPS * STAMP_SIZE;

static constexpr uint8_t ON_D = bit_on_d(PIN_RX_AILERONS) | bit_on_d(PIN_RX_ELEVATOR) |
                                bit_on_d(PIN_RX_THROTTLE) | bit_on_d(PIN_RX_RUDDER) |
                                bit_on_d(PIN_RX_AUX1) | bit_on_d(PIN_RX_AUX2);
static constexpr uint8_t ON_B = bit_on_b(PIN_RX_AILERONS) | bit_on_b(PIN_RX_ELEVATOR) |
                                bit_on_b(PIN_RX_THROTTLE) | bit_on_b(PIN_RX_RUDDER) |
                                bit_on_b(PIN_RX_AUX1) | bit_on_b(PIN_RX_AUX2);
/** A bit that no input has, in the byte in which both ports' inputs are put. */
static constexpr uint8_t LATE = (ON_D | ON_B) & 0x80 ? 0x02 : 0x80;
static constexpr uint8_t INTERRUPTS = (ON_D ? _BV(PCIE2) : 0) | (ON_B ? _BV(PCIE0) : 0);

static_assert((ON_D & ON_B) == 0 && ((ON_D | ON_B) & LATE) == 0, "the inputs fit one byte");
static_assert(bit_on_c(PIN_RX_AILERONS) == 0, "no input on port C");

/** Stamp low, stamp high, levels; GPIOR2 is the index of the next entry. */
static volatile uint8_t ring[RING_SIZE];
static volatile uint8_t oldest;

static inline uint8_t after(uint8_t place) {
  place = static_cast<uint8_t>(place + STAMP_SIZE);
  return place == RING_SIZE ? 0 : place;
}

void begin() {
  DDRD &= static_cast<uint8_t>(~ON_D);
  DDRB &= static_cast<uint8_t>(~ON_B);
  PORTD |= ON_D;
  PORTB |= ON_B;
  GPIOR0 = 0;
  GPIOR2 = 0;
  oldest = 0;
  PCMSK2 = ON_D;
  PCMSK0 = ON_B;
  PCIFR = INTERRUPTS;
  PCICR = INTERRUPTS;
}

/** The six levels, a bit a channel, from the byte that the interrupt stored. */
static uint8_t channels(uint8_t stored) {
  uint8_t levels = 0;
  if (stored & pin_bit(PIN_RX_AILERONS)) levels |= 1 << AILERONS;
  if (stored & pin_bit(PIN_RX_ELEVATOR)) levels |= 1 << ELEVATOR;
  if (stored & pin_bit(PIN_RX_THROTTLE)) levels |= 1 << THROTTLE;
  if (stored & pin_bit(PIN_RX_RUDDER)) levels |= 1 << RUDDER;
  if (stored & pin_bit(PIN_RX_AUX1)) levels |= 1 << AUX1;
  if (stored & pin_bit(PIN_RX_AUX2)) levels |= 1 << AUX2;
  return levels;
}

void drain(PwmReader& receiver, uint32_t now_us) {
  uint8_t place = oldest;
  const uint8_t end = GPIOR2;
  while (place != end) {
    const uint16_t stamp = static_cast<uint16_t>(ring[place] | ring[place + 1] << 8);
    const uint8_t stored = ring[place + 2];
    place = after(place);
    oldest = place;
    receiver.on_edge(stamp, channels(stored), stored & LATE, now_us);
  }
  if (GPIOR0 & _BV(NOTE_LOST)) {
    receiver.on_lost_edges();
    GPIOR0 &= static_cast<uint8_t>(~_BV(NOTE_LOST));
    PCIFR = INTERRUPTS;
    PCICR = INTERRUPTS;
  }
}

}  // namespace edges

/**
 * An input changed. One routine reads both ports, so that simultaneous edges share one stamp.
 * Flags are cleared before the ports are read: a later edge requests the interrupt again.
 *
 * In assembler, as the next edge often follows within microseconds: 5 us from edge to edge, with
 * the stamp 1.4 us after the edge. In C it would be, with `late` as in interrupts_off.h:
 *   PCIFR = INTERRUPTS; ring[GPIOR2] = {TCNT1, (PIND & ON_D) | (PINB & ON_B) | late};
 *   if (after(GPIOR2) == oldest) { GPIOR0 |= 1 << NOTE_LOST; PCICR = 0; }
 *   else GPIOR2 = after(GPIOR2);
 */
ISR(PCINT2_vect, ISR_NAKED) {
  using namespace edges;
  __asm__ __volatile__(
      "push r24\n\t"
      "in r24, __SREG__\n\t"
      "push r24\n\t"
      "push r25\n\t"
      "push r30\n\t"
      "push r31\n\t"
      "ldi r24, %[interrupts]\n\t"
      "out %[pcifr], r24\n\t"
      "lds r24, %[count]\n\t"
      "lds r25, %[count]+1\n\t"
      "in r30, %[pins_d]\n\t"
      "in r31, %[pins_b]\n\t"
      "andi r30, %[on_d]\n\t"
      "andi r31, %[on_b]\n\t"
      "or r30, r31\n\t"
      "sbic %[notes], %[note_late]\n\t"
      "ori r30, %[late]\n\t"
      "cbi %[notes], %[note_late]\n\t"
      "in r31, %[ended]\n\t"  // ticks since an interrupt ended, negative
      "sub r31, r24\n\t"
      "cpi r31, %[just_ended]\n\t"
      "brlo 1f\n\t"
      "ori r30, %[late]\n"
      "1:\tpush r30\n\t"
      "in r30, %[head]\n\t"
      "ldi r31, 0\n\t"
      "subi r30, lo8(-(%[ring]))\n\t"
      "sbci r31, hi8(-(%[ring]))\n\t"
      "st Z, r24\n\t"
      "std Z+1, r25\n\t"
      "pop r24\n\t"
      "std Z+2, r24\n\t"
      "in r30, %[head]\n\t"
      "subi r30, -%[size]\n\t"
      "cpi r30, %[end]\n\t"
      "brne 2f\n\t"
      "ldi r30, 0\n"
      "2:\tlds r24, %[oldest]\n\t"
      "cp r30, r24\n\t"
      "breq 4f\n\t"
      "out %[head], r30\n"
      "3:\tlds r24, %[timer]\n\t"
      "out %[ended], r24\n\t"
      "pop r31\n\t"
      "pop r30\n\t"
      "pop r25\n\t"
      "pop r24\n\t"
      "out __SREG__, r24\n\t"
      "pop r24\n\t"
      "reti\n"
      "4:\tsbi %[notes], %[note_lost]\n\t"
      "ldi r24, 0\n\t"
      "sts %[pcicr], r24\n\t"
      "rjmp 3b"
      :
      : [interrupts] "n"(INTERRUPTS + 0), [pcifr] "I"(_SFR_IO_ADDR(PCIFR)),
        [count] "n"(_SFR_MEM_ADDR(TCNT1)), [timer] "n"(_SFR_MEM_ADDR(TCNT2)),
        [pcicr] "n"(_SFR_MEM_ADDR(PCICR)), [pins_d] "I"(_SFR_IO_ADDR(PIND)),
        [pins_b] "I"(_SFR_IO_ADDR(PINB)), [on_d] "n"(ON_D + 0), [on_b] "n"(ON_B + 0),
        [late] "n"(LATE + 0),
        [notes] "I"(_SFR_IO_ADDR(GPIOR0)), [note_late] "I"(NOTE_LATE), [note_lost] "I"(NOTE_LOST),
        [ended] "I"(_SFR_IO_ADDR(GPIOR1)), [head] "I"(_SFR_IO_ADDR(GPIOR2)),
        [just_ended] "n"(256 - AFTER_INTERRUPT_TICKS), [ring] "i"(ring), [oldest] "i"(&oldest),
        [size] "n"(STAMP_SIZE), [end] "n"(RING_SIZE));
}
ISR(PCINT0_vect, ISR_ALIASOF(PCINT2_vect));

}  // namespace raspilot
