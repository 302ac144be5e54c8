/** The board on a PC: a serial line that drains at its baud rate and an EEPROM that takes its time. */
#pragma once

#include <stdint.h>

#include <vector>

namespace raspilot {

constexpr uint16_t EEPROM_SIZE = 1024;
constexpr uint8_t SERIAL_CAPACITY = 127;
constexpr uint32_t EEPROM_WRITE_US = 3400;

/** Implements board.h; `reset()` makes a new board with an erased EEPROM. */
class FakeBoard {
 public:
  FakeBoard() { reset(); }

  void reset();
  /** Power returns: EEPROM keeps its bytes, everything else is new. */
  void power_on();
  /** Time passes: the line sends bytes, the EEPROM finishes its write. */
  void elapse(uint32_t us);
  /** Takes the bytes that the firmware has sent so far. */
  std::vector<uint8_t> take_sent();

  uint8_t eeprom[EEPROM_SIZE];
  /** The write under way when power is cut may leave any value in this cell. */
  uint16_t newest_address;
  /** Bytes really written (equal ones are not). */
  uint32_t writes;
  /** Uses of the board against its contract; a test demands 0. */
  uint32_t violations;
  /** Bytes in the output buffer, at most SERIAL_CAPACITY; a test may fill it. */
  uint32_t queued;
  uint32_t baud;
  std::vector<uint8_t> sent;
  /** Put and not yet sent. */
  uint8_t put[SERIAL_CAPACITY];
  uint32_t eeprom_busy_us;

 private:
  uint64_t line_credit_;
};

/** The board that the firmware under test speaks to. */
FakeBoard& fake_board();

}  // namespace raspilot
