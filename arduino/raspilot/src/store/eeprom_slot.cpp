#include "eeprom_slot.h"

#include "../core/board.h"
#include "../protocol/crc16.h"

namespace raspilot {

namespace {

constexpr uint8_t ERASED = 0xFF;

}  // namespace

bool read_slot(uint16_t address, uint8_t version, uint8_t size, uint8_t* data, uint8_t& sequence) {
  if (board::eeprom_read(address) != SLOT_MARK) return false;
  if (board::eeprom_read(++address) != version) return false;
  sequence = board::eeprom_read(++address);
  Crc16 crc;
  crc.put(version);
  crc.put(sequence);
  for (uint8_t at = 0; at < size; ++at) {
    data[at] = board::eeprom_read(++address);
    crc.put(data[at]);
  }
  crc.put(board::eeprom_read(++address));
  crc.put(board::eeprom_read(++address));
  return crc.is_zero();
}

bool is_slot_erased(uint16_t address) {
  // Two cells: one alone may have lost its value.
  return board::eeprom_read(address) == ERASED && board::eeprom_read(++address) == ERASED;
}

}  // namespace raspilot
