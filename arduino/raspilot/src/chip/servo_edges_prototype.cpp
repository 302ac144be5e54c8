/**
 * The servo edges of the thesis's board, whose pins no timer moves: the interrupts of the same
 * compare registers do it, as late as other interrupts make them.
 */
#ifdef RASPILOT_PROTOTYPE_BOARD

#include "interrupts_off.h"
#include "pins.h"
#include "servo_edges.h"

namespace raspilot {
namespace servo_edges {

static volatile uint16_t widths[OUTPUTS];
static volatile uint16_t throttle_edge, rudder_edge;

static constexpr uint8_t PINS = bit_on_c(PIN_SERVO_AILERONS) | bit_on_c(PIN_SERVO_ELEVATOR) |
                                bit_on_c(PIN_ESC_THROTTLE) | bit_on_c(PIN_SERVO_RUDDER);
static_assert((PINS & (PINS - 1)) && !(PINS & 0x30), "four pins of port C beside the IMU's bus");

void begin() {
  for (uint8_t i = 0; i < OUTPUTS; i++) widths[i] = us_to_ticks(i == THROTTLE ? 1000 : 1500);
  PORTC &= static_cast<uint8_t>(~PINS);
  DDRC |= PINS;
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
      TIFR1 = _BV(OCF1A);
      TIMSK1 |= _BV(OCIE1A);
      break;
    case ELEVATOR:
      OCR1B = rise_ticks;
      TIFR1 = _BV(OCF1B);
      TIMSK1 |= _BV(OCIE1B);
      break;
    case THROTTLE:
      throttle_edge = rise_ticks;
      OCR2B = static_cast<uint8_t>(rise_ticks);
      TIFR2 = _BV(OCF2B);
      TIMSK2 |= _BV(OCIE2B);
      break;
    default:
      rudder_edge = rise_ticks;
      OCR2A = static_cast<uint8_t>(rise_ticks);
      TIFR2 = _BV(OCF2A);
      TIMSK2 |= _BV(OCIE2A);
      break;
  }
  note_waiting_edge();
}

void set_width(Channel channel, Ticks width) {
  InterruptsOff off;
  widths[channel] = static_cast<uint16_t>(width);
}

}  // namespace servo_edges

/** The pin's level distinguishes the edges. */
#define RASPILOT_EDGE_OF_TIMER1(VECTOR, PIN, COMPARE, CHANNEL, ENABLE)   \
  ISR(VECTOR) {                                                          \
    if (PORTC & bit_on_c(PIN)) {                                         \
      PORTC &= static_cast<uint8_t>(~bit_on_c(PIN));                     \
      TIMSK1 &= static_cast<uint8_t>(~_BV(ENABLE));                      \
    } else {                                                             \
      PORTC |= bit_on_c(PIN);                                            \
      COMPARE += servo_edges::widths[CHANNEL];                           \
    }                                                                    \
    note_end_of_interrupt();                                                 \
  }

#define RASPILOT_EDGE_OF_TIMER2(VECTOR, PIN, COMPARE, EDGE, CHANNEL, ENABLE) \
  ISR(VECTOR) {                                                              \
    if (static_cast<int16_t>(EDGE - TCNT1) > 0) {                            \
    } else if (PORTC & bit_on_c(PIN)) {                                      \
      PORTC &= static_cast<uint8_t>(~bit_on_c(PIN));                         \
      TIMSK2 &= static_cast<uint8_t>(~_BV(ENABLE));                          \
    } else {                                                                 \
      PORTC |= bit_on_c(PIN);                                                \
      EDGE += servo_edges::widths[CHANNEL];                                  \
      COMPARE = static_cast<uint8_t>(EDGE);                                  \
    }                                                                        \
    note_end_of_interrupt();                                                     \
  }

RASPILOT_EDGE_OF_TIMER1(TIMER1_COMPA_vect, PIN_SERVO_AILERONS, OCR1A, AILERONS, OCIE1A)
RASPILOT_EDGE_OF_TIMER1(TIMER1_COMPB_vect, PIN_SERVO_ELEVATOR, OCR1B, ELEVATOR, OCIE1B)
RASPILOT_EDGE_OF_TIMER2(TIMER2_COMPA_vect, PIN_SERVO_RUDDER, OCR2A, servo_edges::rudder_edge,
                        RUDDER, OCIE2A)
RASPILOT_EDGE_OF_TIMER2(TIMER2_COMPB_vect, PIN_ESC_THROTTLE, OCR2B, servo_edges::throttle_edge,
                        THROTTLE, OCIE2B)

}  // namespace raspilot

#endif
