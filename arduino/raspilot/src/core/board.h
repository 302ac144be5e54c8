/**
 * The interface of the portable part to the board. The chip (src/chip) implements it on an
 * ATmega328P; the host build implements it with fakes. Nothing here waits.
 */
#pragma once

#include <stdint.h>

namespace raspilot {
namespace board {

/** Bytes that the serial line's output buffer takes now. */
uint8_t serial_room();
/** Puts a byte `at` places behind the queued bytes; the caller has checked serial_room() before. */
void serial_put(uint8_t at, uint8_t byte);
/** Queues the first `count` bytes that were put. */
void serial_send(uint8_t count);

/** Whether EEPROM takes a write now (a byte takes 3.4 ms, data sheet 8.6.3). */
bool eeprom_is_ready();
/** Only when eeprom_is_ready(), as the write. */
uint8_t eeprom_read(uint16_t address);
/** Begins the write of one byte; only when eeprom_is_ready(). Equal bytes are not written. */
void eeprom_write(uint16_t address, uint8_t value);

}  // namespace board
}  // namespace raspilot
