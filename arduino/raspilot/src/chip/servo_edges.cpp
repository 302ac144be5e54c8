#ifndef RASPILOT_PROTOTYPE_BOARD

#include "servo_edges.h"

#include "interrupts_off.h"
#include "pins.h"

namespace raspilot {
namespace servo_edges {

static_assert(PIN_SERVO_AILERONS == 9 && PIN_SERVO_ELEVATOR == 10, "OC1A and OC1B");
static_assert(PIN_SERVO_RUDDER == 11 && PIN_ESC_THROTTLE == 3, "OC2A and OC2B");

static volatile uint16_t widths[OUTPUTS];
/** When the next edge of Timer2's outputs is due. */
static volatile uint16_t throttle_edge, rudder_edge;

/** What a match does to a pin: COMnx1 alone clears it, COMnx0 too sets it. */
static inline void let_set(volatile uint8_t& control, uint8_t com0) { control |= com0; }
static inline void let_clear(volatile uint8_t& control, uint8_t com0) {
  control &= static_cast<uint8_t>(~com0);
}

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
  switch (channel) {
    case AILERONS: return TIMSK1 & _BV(OCIE1A);
    case ELEVATOR: return TIMSK1 & _BV(OCIE1B);
    case THROTTLE: return TIMSK2 & _BV(OCIE2B);
    default: return TIMSK2 & _BV(OCIE2A);
  }
}

void plan(Channel channel, uint16_t rise_ticks) {
  InterruptsOff off;
  switch (channel) {
    case AILERONS:
      OCR1A = rise_ticks;
      let_set(TCCR1A, _BV(COM1A0));
      TIFR1 = _BV(OCF1A);
      TIMSK1 |= _BV(OCIE1A);
      break;
    case ELEVATOR:
      OCR1B = rise_ticks;
      let_set(TCCR1A, _BV(COM1B0));
      TIFR1 = _BV(OCF1B);
      TIMSK1 |= _BV(OCIE1B);
      break;
    case THROTTLE:
      throttle_edge = rise_ticks;
      GPIOR0 |= _BV(NOTE_RISES_THROTTLE);
      OCR2B = static_cast<uint8_t>(rise_ticks);
      TIFR2 = _BV(OCF2B);
      TIMSK2 |= _BV(OCIE2B);
      break;
    default:
      rudder_edge = rise_ticks;
      GPIOR0 |= _BV(NOTE_RISES_RUDDER);
      OCR2A = static_cast<uint8_t>(rise_ticks);
      TIFR2 = _BV(OCF2A);
      TIMSK2 |= _BV(OCIE2A);
      break;
  }
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
    let_clear(TCCR1A, _BV(COM1A0));
  } else {
    TIMSK1 &= static_cast<uint8_t>(~_BV(OCIE1A));
  }
  note_end_of_interrupt();
}

ISR(TIMER1_COMPB_vect) {
  using namespace servo_edges;
  if (TCCR1A & _BV(COM1B0)) {
    OCR1B += widths[ELEVATOR];
    let_clear(TCCR1A, _BV(COM1B0));
  } else {
    TIMSK1 &= static_cast<uint8_t>(~_BV(OCIE1B));
  }
  note_end_of_interrupt();
}

/**
 * A round of Timer2 has ended for this output. `force` strobes its pin to what a match would do:
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
  on_round(servo_edges::rudder_edge, OCR2A, servo_edges::widths[RUDDER], NOTE_RISES_RUDDER, _BV(COM2A0), _BV(FOC2A),
           _BV(OCIE2A));
}

ISR(TIMER2_COMPB_vect) {
  on_round(servo_edges::throttle_edge, OCR2B, servo_edges::widths[THROTTLE], NOTE_RISES_THROTTLE, _BV(COM2B0),
           _BV(FOC2B), _BV(OCIE2B));
}

}  // namespace raspilot

#endif
