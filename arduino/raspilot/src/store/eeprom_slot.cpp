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

bool is_slot_erased(uint16_t address, uint8_t size) {
  for (uint8_t at = 0; at < size + SLOT_OVERHEAD; ++at) {
    if (board::eeprom_read(static_cast<uint16_t>(address + at)) != ERASED) return false;
  }
  return true;
}

}  // namespace raspilot
