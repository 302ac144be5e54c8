/** USART0 and the two wires to the Raspberry Pi (data sheet 20): bytes take their time. */
#include <algorithm>
#include <deque>
#include <vector>

#include "avr/interrupt.h"
#include "chip/uart.h"
#include "hardware.h"

ISR(USART_RX_vect);
ISR(USART_UDRE_vect);

namespace host {
namespace line {

namespace {

constexpr double BITS = 10;
/** A byte is in when the middle of its stop bit has been sampled. */
constexpr double BITS_TO_READ = 9.5;
constexpr double BIT = 1e6 * PER_US / RASPILOT_BAUD;

struct Coming {
  Cycles at;
  uint8_t value;
};

std::deque<Coming> coming;
std::vector<uint8_t> sent;
double wire_free;
Cycles ran_to;
Cycles sending_ends;
uint8_t sending;
uint8_t waiting;
bool is_sending;
bool is_waiting;

/** By the divider that the firmware has set: a little faster than its name at 115200 Bd. */
Cycles byte_time() { return static_cast<Cycles>(BITS) * 8 * (UBRR0 + 1); }

void receive(Cycles moment) {
  for (; !coming.empty() && coming.front().at <= moment; coming.pop_front()) {
    if (!(UCSR0B & _BV(RXEN0))) continue;
    UDR0 = coming.front().value;
    USART_RX_vect();
  }
}

void begin_byte(uint8_t value, Cycles moment) {
  sending = value;
  is_sending = true;
  sending_ends = moment + byte_time();
}

void end_byte() {
  sent.push_back(sending);
  is_sending = is_waiting;
  if (is_waiting) begin_byte(waiting, sending_ends);
  is_waiting = false;
}

/** The register is empty: the interrupt fills it, and the shift register takes it if that is. */
void fill(Cycles moment) {
  USART_UDRE_vect();
  if (is_sending) {
    waiting = UDR0;
    is_waiting = true;
  } else {
    begin_byte(UDR0, moment);
  }
}

}  // namespace

void write(const uint8_t* bytes, uint32_t size) {
  for (uint32_t at = 0; at < size; ++at) {
    const double start = std::max(wire_free, static_cast<double>(now()));
    coming.push_back(Coming{static_cast<Cycles>(start + BITS_TO_READ * BIT), bytes[at]});
    wire_free = start + BITS * BIT;
  }
}

uint32_t read(uint8_t* into, uint32_t size) {
  const uint32_t count = std::min(size, static_cast<uint32_t>(sent.size()));
  std::copy(sent.begin(), sent.begin() + count, into);
  sent.erase(sent.begin(), sent.begin() + count);
  return count;
}

void run(Cycles moment) {
  receive(moment);
  for (;;) {
    if (is_sending && sending_ends <= moment) {
      end_byte();
    } else if (UCSR0B & _BV(UDRIE0) && !is_waiting) {
      // It was requested when time stood still last.
      fill(ran_to);
    } else {
      break;
    }
  }
  ran_to = moment;
}

void reset() { is_sending = is_waiting = false; }

}  // namespace line
}  // namespace host
