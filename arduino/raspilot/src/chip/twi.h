/** The bus to the IMU as master, 400 kHz, pumped by polling; nothing here waits (data sheet 22). */
#pragma once

#include <stdint.h>

namespace raspilot {

/** One transfer at a time: a register's address, then bytes written to or read from there. */
class Twi {
 public:
  enum class State : uint8_t { IDLE, BUSY, DONE, FAILED };

  /** Frees the bus from a slave that hangs in a byte: up to nine clocks, then a stop. */
  void begin_recovery();
  void begin_write(uint8_t device, uint8_t at, uint8_t value);
  /** `bytes` stays the caller's until the transfer has ended. */
  void begin_read(uint8_t device, uint8_t at, uint8_t* bytes, uint8_t count);
  /** Continues if the hardware has finished a step; takes a few microseconds. */
  State pump();
  /** Aborts a transfer that has not ended, and releases the lines. */
  void abandon();
  State state() const { return state_; }

 private:
  void start();
  void recover();

  uint8_t* bytes_;
  uint16_t clocked_ticks_;
  uint8_t device_;
  uint8_t at_;
  uint8_t value_;
  uint8_t left_;
  uint8_t clocks_;
  bool is_read_;
  State state_;
};

}  // namespace raspilot
