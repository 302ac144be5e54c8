/** The EEPROM (data sheet 8.4, 8.6): a byte takes 3.4 ms, in which power may be cut. */
#include <string.h>

#include "chip/eeprom.h"
#include "core/board.h"
#include "hardware.h"

namespace host {
namespace memory {

namespace {

constexpr uint16_t SIZE = sizeof view.eeprom;
constexpr Cycles WRITE = 3400 * PER_US;
constexpr Cycles MAX_WAIT = 10000 * PER_US;
constexpr Cycles LOOK = 100 * PER_US;
/** To read a byte, check it and put it in its place. */
constexpr Cycles READ = 10 * PER_US;

uint8_t* const contents = view.eeprom;
uint16_t address;
uint8_t value;
Cycles done = NEVER;
uint32_t noise;

}  // namespace

void begin(const uint8_t* bytes, uint32_t size, uint32_t seed) {
  memset(contents, 0xFF, SIZE);
  memcpy(contents, bytes, size < SIZE ? size : SIZE);
  noise = seed | 1;
}

void run(Cycles moment) {
  if (done > moment) return;
  contents[address] = value;
  done = NEVER;
}

void cut() {
  if (done == NEVER) return;
  noise ^= noise << 13;
  noise ^= noise >> 17;
  noise ^= noise << 5;
  // Erased first, then written: some bits are complete, others are not.
  contents[address] = static_cast<uint8_t>(value | noise);
  done = NEVER;
}

}  // namespace memory
}  // namespace host

namespace raspilot {

namespace eeprom {

void begin() {
  const host::Cycles end = host::now() + host::memory::MAX_WAIT;
  while (!board::eeprom_is_ready() && host::now() < end) host::pass(host::memory::LOOK);
}

}  // namespace eeprom

namespace board {

using namespace host::memory;

bool eeprom_is_ready() { return done == host::NEVER; }

uint8_t eeprom_read(uint16_t from) {
  host::pass(READ);
  return contents[from % SIZE];
}

void eeprom_write(uint16_t to, uint8_t byte) {
  if (contents[to % SIZE] == byte) return;
  address = to % SIZE;
  value = byte;
  done = host::now() + WRITE;
}

}  // namespace board
}  // namespace raspilot
