#include "uart.h"

#include "../core/board.h"
#include "../core/compiler.h"
#include "../protocol/forwarder.h"
#include "../protocol/frame.h"
#include "interrupts_off.h"

namespace raspilot {
namespace uart {

/** Two of the longest Commands arrive faster than a full slot reads them: 11 ms of bytes. */
static constexpr uint8_t RX_SIZE = 128;
/** The longest message that is ever sent, and one place that stays empty. */
static constexpr uint8_t TX_SIZE = MAX_COMMAND + FRAME_OVERHEAD + COBS_OVERHEAD + 1;
static constexpr uint16_t DIVIDER = (F_CPU / 4 / RASPILOT_BAUD - 1) / 2;

static uint8_t rx[RX_SIZE];
static uint8_t tx[TX_SIZE];
static volatile uint8_t rx_head, rx_tail, tx_head, tx_tail;

static inline uint8_t after(uint8_t place, uint8_t size) {
  place = static_cast<uint8_t>(place + 1);
  return place == size ? 0 : place;
}

/** The place `at` places behind the queued bytes. */
static uint8_t tx_place(uint8_t at) {
  const uint8_t place = static_cast<uint8_t>(tx_head + at);
  return place < TX_SIZE ? place : static_cast<uint8_t>(place - TX_SIZE);
}

void begin() {
  UCSR0B = 0;
  UBRR0 = DIVIDER;
  UCSR0A = _BV(U2X0);
  UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
  UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

bool is_next_zero() { return rx_tail != rx_head && rx[rx_tail] == 0; }

bool read(uint8_t& byte) {
  const uint8_t tail = rx_tail;
  if (tail == rx_head) return false;
  byte = rx[tail];
  rx_tail = after(tail, RX_SIZE);
  return true;
}

}  // namespace uart

namespace board {

uint8_t serial_room() {
  const uint8_t head = uart::tx_head;
  const uint8_t tail = uart::tx_tail;
  return static_cast<uint8_t>(tail - head - 1 + (tail > head ? 0 : uart::TX_SIZE));
}

OUT_OF_LINE void serial_put(uint8_t at, uint8_t byte) { uart::tx[uart::tx_place(at)] = byte; }

void serial_send(uint8_t count) {
  uart::tx_head = uart::tx_place(count);
  InterruptsOff off;
  UCSR0B |= _BV(UDRIE0);
}

}  // namespace board

/** A byte that finds the ring full is dropped: the frame's checksum will miss it. */
ISR(USART_RX_vect) {
  using namespace uart;
  const uint8_t byte = UDR0;
  const uint8_t head = rx_head;
  const uint8_t next = after(head, RX_SIZE);
  if (next != rx_tail) {
    rx[head] = byte;
    rx_head = next;
  }
  note_end_of_interrupt();
}

ISR(USART_UDRE_vect) {
  using namespace uart;
  const uint8_t tail = tx_tail;
  UDR0 = tx[tail];
  const uint8_t next = after(tail, TX_SIZE);
  tx_tail = next;
  if (next == tx_head) UCSR0B &= static_cast<uint8_t>(~_BV(UDRIE0));
  note_end_of_interrupt();
}

}  // namespace raspilot
