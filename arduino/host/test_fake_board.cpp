#include <doctest/doctest.h>

#include "core/board.h"
#include "fake_board.h"

using namespace raspilot;

namespace {

void write(uint8_t byte) {
  board::serial_put(0, byte);
  board::serial_send(1);
}

}  // namespace

TEST_CASE("the board's line takes what it has room for and drains at its baud rate") {
  fake_board().reset();
  CHECK(board::serial_room() == SERIAL_CAPACITY);
  for (int count = 0; count < SERIAL_CAPACITY; ++count) write('x');
  CHECK(board::serial_room() == 0);
  CHECK(fake_board().violations == 0);
  write('x');
  CHECK(fake_board().violations == 1);
  fake_board().elapse(868);
  CHECK(board::serial_room() == 9);
  CHECK(fake_board().take_sent().size() == SERIAL_CAPACITY);
}

TEST_CASE("the board's EEPROM takes 3.4 ms a byte and skips equal ones") {
  fake_board().reset();
  board::eeprom_write(7, 0xFF);
  CHECK(board::eeprom_is_ready());
  board::eeprom_write(7, 1);
  CHECK_FALSE(board::eeprom_is_ready());
  fake_board().elapse(3399);
  CHECK_FALSE(board::eeprom_is_ready());
  fake_board().elapse(1);
  CHECK(board::eeprom_is_ready());
  CHECK(board::eeprom_read(7) == 1);
  CHECK(fake_board().writes == 1);
}
