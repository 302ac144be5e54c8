/**
 * One copy of one kind of settings in EEPROM: mark, version, sequence, data, checksum.
 *
 * The mark is the last byte that a save writes and the first that it takes away, so that a power
 * cut at any byte leaves a slot that is either whole or not there.
 */
#pragma once

#include <stdint.h>

namespace raspilot {

/** EEPROM's first bytes stay unused: a brown-out is known to hit address 0. */
constexpr uint16_t FIRST_SLOT_ADDRESS = 32;
constexpr uint8_t SLOT_ROOM = 96;
constexpr uint8_t SLOTS_A_KIND = 2;
constexpr uint8_t SLOT_MARK = 0xA5;
constexpr uint8_t SLOT_NO_MARK = 0x00;
constexpr uint8_t SLOT_HEADER_SIZE = 3;
constexpr uint8_t SLOT_OVERHEAD = SLOT_HEADER_SIZE + 2;

/** Where slot 0 or 1 of a kind lies. */
constexpr uint16_t slot_address(uint8_t kind, uint8_t slot) {
  return static_cast<uint16_t>(FIRST_SLOT_ADDRESS + (kind * SLOTS_A_KIND + slot) * SLOT_ROOM);
}

/** Copies the slot's data; false when mark, version or checksum is wrong. */
bool read_slot(uint16_t address, uint8_t version, uint8_t size, uint8_t* data, uint8_t& sequence);
/** Whether nothing was ever written there: a save changes the mark first, and nothing erases. */
bool is_slot_erased(uint16_t address);

}  // namespace raspilot
