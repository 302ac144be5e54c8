#ifndef RASPILOT_PROTOTYPE_BOARD

#include "servo_edges.h"

#include "interrupts_off.h"
#include "pins.h"

namespace raspilot {
namespace servo_edges {

static_assert(PIN_SERVO_AILERONS == 9 && PIN_SERVO_ELEVATOR == 10, "OC1A and OC1B");
static_assert(PIN_SERVO_RUDDER == 11 && PIN_ESC_THROTTLE == 3, "OC2A and OC2B");

static volatile uint16_t widths[OUTPUTS];
/** When the next edges of OC2A and OC2B are due. */
static volatile uint16_t edges_of_timer2[2];

/** Ailerons are OC1A, elevator OC1B, rudder OC2A, throttle OC2B: 0 for A, 1 for B. */
static inline uint8_t side_of(Channel channel) {
  return channel == ELEVATOR || channel == THROTTLE ? 1 : 0;
}
static inline bool is_on_timer1(Channel channel) { return channel < THROTTLE; }

/** The side's bit in TIMSKn and TIFRn, the same for both timers. */
static inline uint8_t interrupt_of(uint8_t side) { return side ? _BV(OCIE1B) : _BV(OCIE1A); }
static_assert(OCIE1A == OCIE2A && OCIE1B == OCIE2B && OCF1A == OCIE1A && OCF1B == OCIE1B &&
              OCF2A == OCIE2A && OCF2B == OCIE2B, "one bit for all");

/** COMnx1 alone makes a match clear the pin, COMnx0 beside it makes it set the pin. */
void begin() {
  PORTB &= static_cast<uint8_t>(
      ~(pin_bit(PIN_SERVO_AILERONS) | pin_bit(PIN_SERVO_ELEVATOR) | pin_bit(PIN_SERVO_RUDDER)));
  PORTD &= static_cast<uint8_t>(~pin_bit(PIN_ESC_THROTTLE));
  for (uint8_t i = 0; i < OUTPUTS; i++) widths[i] = us_to_ticks(i == THROTTLE ? 1000 : 1500);
  TCCR1A = _BV(COM1A1) | _BV(COM1B1);
  TCCR2A = _BV(COM2A1) | _BV(COM2B1);
  TCCR1C = _BV(FOC1A) | _BV(FOC1B);
  TCCR2B = _BV(CS21) | _BV(FOC2A) | _BV(FOC2B);
  DDRB |= pin_bit(PIN_SERVO_AILERONS) | pin_bit(PIN_SERVO_ELEVATOR) | pin_bit(PIN_SERVO_RUDDER);
  DDRD |= pin_bit(PIN_ESC_THROTTLE);
}

bool is_busy(Channel channel) {
  return (is_on_timer1(channel) ? TIMSK1 : TIMSK2) & interrupt_of(side_of(channel));
}

void plan(Channel channel, uint16_t rise_ticks) {
  const uint8_t side = side_of(channel);
  const uint8_t interrupt = interrupt_of(side);
  InterruptsOff off;
  if (is_on_timer1(channel)) {
    (&OCR1A)[side] = rise_ticks;
    TCCR1A |= side ? _BV(COM1B0) : _BV(COM1A0);
    TIFR1 = interrupt;
    TIMSK1 |= interrupt;
  } else {
    edges_of_timer2[side] = rise_ticks;
    (&OCR2A)[side] = static_cast<uint8_t>(rise_ticks);
    GPIOR0 |= side ? _BV(NOTE_RISES_THROTTLE) : _BV(NOTE_RISES_RUDDER);
    TIFR2 = interrupt;
    TIMSK2 |= interrupt;
  }
  note_waiting_edge();
}

void set_width(Channel channel, Ticks width) {
  InterruptsOff off;
  widths[channel] = static_cast<uint16_t>(width);
}

}  // namespace servo_edges

ISR(TIMER1_COMPA_vect) {
  using namespace servo_edges;
  if (TCCR1A & _BV(COM1A0)) {
    OCR1A += widths[AILERONS];
    TCCR1A &= static_cast<uint8_t>(~_BV(COM1A0));
  } else {
    TIMSK1 &= static_cast<uint8_t>(~_BV(OCIE1A));
  }
  note_end_of_interrupt();
}

ISR(TIMER1_COMPB_vect) {
  using namespace servo_edges;
  if (TCCR1A & _BV(COM1B0)) {
    OCR1B += widths[ELEVATOR];
    TCCR1A &= static_cast<uint8_t>(~_BV(COM1B0));
  } else {
    TIMSK1 &= static_cast<uint8_t>(~_BV(OCIE1B));
  }
  note_end_of_interrupt();
}

/**
 * A round of Timer2 has ended for this output. `force` strobes its pin to the level of a match,
 * only if this interrupt was held up for more than a round, so that no edge is ever missed.
 */
__attribute__((always_inline)) static inline void on_round(
    volatile uint16_t& edge, volatile uint8_t& compare, volatile uint16_t& width, uint8_t note,
    uint8_t com0, uint8_t force, uint8_t enable) {
  // Whole rounds to the edge: with none left the match before it has passed, and the next makes it.
  const int8_t rounds = static_cast<int8_t>((edge - TCNT1) >> 8);
  if (rounds > 0) {
  } else if (GPIOR0 & _BV(note)) {
    const uint8_t told = TCCR2A;
    TCCR2A = told | com0;
    if (rounds < 0) {
      if (!(told & com0)) TCCR2B = _BV(CS21) | force;
      const uint16_t fall = edge + width;
      edge = fall;
      compare = static_cast<uint8_t>(fall);
      GPIOR0 &= static_cast<uint8_t>(~_BV(note));
    }
  } else {
    const uint8_t told = TCCR2A;
    TCCR2A = told & static_cast<uint8_t>(~com0);
    if (rounds < 0) {
      if (told & com0) TCCR2B = _BV(CS21) | force;
      TIMSK2 &= static_cast<uint8_t>(~enable);
    }
  }
  note_end_of_interrupt();
}

ISR(TIMER2_COMPA_vect) {
  using namespace servo_edges;
  on_round(edges_of_timer2[0], OCR2A, widths[RUDDER], NOTE_RISES_RUDDER, _BV(COM2A0), _BV(FOC2A),
           _BV(OCIE2A));
}

ISR(TIMER2_COMPB_vect) {
  using namespace servo_edges;
  on_round(edges_of_timer2[1], OCR2B, widths[THROTTLE], NOTE_RISES_THROTTLE, _BV(COM2B0),
           _BV(FOC2B), _BV(OCIE2B));
}

}  // namespace raspilot

#endif
