#include "edges.h"

#include "interrupts_off.h"
#include "pins.h"

namespace raspilot {
namespace edges {

static constexpr uint8_t STAMPS = 32;
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

/** Stamp low, stamp high, levels; GPIOR2 is where the next goes. */
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
  while (place != GPIOR2) {
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
 * An input changed. One routine reads both ports, so that edges that come together share one
 * stamp. Flags are cleared before the ports are read: what comes later asks again.
 */
ISR(PCINT2_vect) {
  using namespace edges;
  PCIFR = INTERRUPTS;
  const uint16_t stamp = TCNT1;
  uint8_t levels = static_cast<uint8_t>((PIND & ON_D) | (PINB & ON_B));
  if (is_after_interrupt(static_cast<uint8_t>(stamp))) levels |= LATE;
  if (GPIOR0 & _BV(NOTE_LATE)) levels |= LATE;
  GPIOR0 &= static_cast<uint8_t>(~_BV(NOTE_LATE));
  const uint8_t place = GPIOR2;
  const uint8_t next = after(place);
  volatile uint8_t* const at = &ring[place];
  at[0] = static_cast<uint8_t>(stamp);
  at[1] = static_cast<uint8_t>(stamp >> 8);
  at[2] = levels;
  if (next == oldest) {
    GPIOR0 |= _BV(NOTE_LOST);
    PCICR = 0;
  } else {
    GPIOR2 = next;
  }
  note_end_of_interrupt();
}
ISR(PCINT0_vect, ISR_ALIASOF(PCINT2_vect));

}  // namespace raspilot
