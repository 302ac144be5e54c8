#include "fake_board.h"

#include <string.h>

#include <algorithm>

#include "core/board.h"

namespace raspilot {

namespace {
constexpr uint64_t BITS_PER_BYTE = 10;
constexpr uint64_t US_PER_S = 1000000;
}  // namespace

FakeBoard& fake_board() {
  static FakeBoard board;
  return board;
}

void FakeBoard::reset() {
  memset(eeprom, 0xFF, sizeof eeprom);
  power_on();
}

void FakeBoard::power_on() {
  newest_address = 0;
  writes = 0;
  violations = 0;
  queued = 0;
  baud = 115200;
  sent.clear();
  eeprom_busy_us = 0;
  line_credit_ = 0;
}

void FakeBoard::elapse(uint32_t us) {
  eeprom_busy_us -= std::min(us, eeprom_busy_us);
  line_credit_ += static_cast<uint64_t>(us) * baud;
  const uint64_t bytes = line_credit_ / (BITS_PER_BYTE * US_PER_S);
  line_credit_ %= BITS_PER_BYTE * US_PER_S;
  queued -= static_cast<uint32_t>(std::min<uint64_t>(bytes, queued));
}

std::vector<uint8_t> FakeBoard::take_sent() {
  std::vector<uint8_t> taken;
  taken.swap(sent);
  return taken;
}

namespace board {

uint8_t serial_room() { return static_cast<uint8_t>(SERIAL_CAPACITY - fake_board().queued); }

void serial_put(uint8_t at, uint8_t byte) {
  FakeBoard& fake = fake_board();
  if (fake.queued + at >= SERIAL_CAPACITY) {
    ++fake.violations;
    return;
  }
  fake.put[at] = byte;
}

void serial_send(uint8_t count) {
  FakeBoard& fake = fake_board();
  count = std::min(count, serial_room());
  fake.queued += count;
  fake.sent.insert(fake.sent.end(), fake.put, fake.put + count);
}

bool eeprom_is_ready() { return fake_board().eeprom_busy_us == 0; }

uint8_t eeprom_read(uint16_t address) {
  FakeBoard& fake = fake_board();
  if (address >= EEPROM_SIZE || !eeprom_is_ready()) {
    ++fake.violations;
    return 0;
  }
  return fake.eeprom[address];
}

void eeprom_write(uint16_t address, uint8_t value) {
  FakeBoard& fake = fake_board();
  if (address >= EEPROM_SIZE || !eeprom_is_ready()) {
    ++fake.violations;
    return;
  }
  if (fake.eeprom[address] == value) return;
  fake.eeprom[address] = value;
  fake.newest_address = address;
  ++fake.writes;
  fake_board().eeprom_busy_us = EEPROM_WRITE_US;
}

}  // namespace board
}  // namespace raspilot
