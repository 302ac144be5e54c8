#include "eeprom.h"

#include "../core/board.h"
#include "clock.h"
#include "interrupts_off.h"

namespace raspilot {

namespace eeprom {

static constexpr uint16_t WRITE_TICKS = 20000;

void begin() {
  const uint16_t start = clock::ticks();
  while (!board::eeprom_is_ready() &&
         static_cast<uint16_t>(clock::ticks() - start) < WRITE_TICKS) {
  }
}

}  // namespace eeprom

namespace board {

bool eeprom_is_ready() { return !(EECR & _BV(EEPE)); }

uint8_t eeprom_read(uint16_t address) {
  EEAR = address;
  EECR |= _BV(EERE);
  return EEDR;
}

void eeprom_write(uint16_t address, uint8_t value) {
  if (eeprom_read(address) == value) return;
  EEDR = value;
  // The write must follow its permission within four cycles (data sheet 8.6.3).
  InterruptsOff off;
  EECR = _BV(EEMPE);
  EECR |= _BV(EEPE);
}

}  // namespace board
}  // namespace raspilot
