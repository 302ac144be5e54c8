#include "twi.h"

#include <avr/io.h>
#include <util/twi.h>

#include "../core/compiler.h"
#include "clock.h"

namespace raspilot {

/** 16 MHz / (16 + 2 * 12) = 400 kHz. */
static constexpr uint8_t DIVIDER = 12;
static constexpr uint8_t SDA = _BV(PC4);
static constexpr uint8_t SCL = _BV(PC5);
static constexpr uint16_t HALF_CLOCK_TICKS = 10;
/** Nine clocks of two halves, then data low, clock high, data high: a stop. */
static constexpr uint8_t RECOVERY_STEPS = 21;

void Twi::begin_recovery() {
  TWCR = 0;
  // One bit each, in one instruction: interrupts move other bits of the port.
  PORTC &= static_cast<uint8_t>(~SDA);
  PORTC &= static_cast<uint8_t>(~SCL);
  DDRC &= static_cast<uint8_t>(~(SDA | SCL));
  clocks_ = RECOVERY_STEPS;
  clocked_ticks_ = clock::ticks();
  state_ = State::BUSY;
}

void Twi::recover() {
  const uint16_t now = clock::ticks();
  if (static_cast<uint16_t>(now - clocked_ticks_) < HALF_CLOCK_TICKS) return;
  clocked_ticks_ = now;
  clocks_--;
  if (clocks_ >= 3) {
    DDRC ^= SCL;
  } else if (clocks_ == 2) {
    DDRC |= SDA;
  } else if (clocks_ == 1) {
    DDRC &= static_cast<uint8_t>(~SCL);
  } else {
    DDRC &= static_cast<uint8_t>(~(SDA | SCL));
    state_ = State::DONE;
  }
}

void Twi::start() {
  TWBR = DIVIDER;
  TWSR = 0;
  TWCR = _BV(TWINT) | _BV(TWSTA) | _BV(TWEN);
  state_ = State::BUSY;
}

void Twi::begin_write(uint8_t device, uint8_t at, uint8_t value) {
  device_ = device;
  at_ = at;
  value_ = value;
  left_ = 1;
  is_read_ = false;
  start();
}

OUT_OF_LINE void Twi::begin_read(uint8_t device, uint8_t at, uint8_t* bytes, uint8_t count) {
  device_ = device;
  at_ = at;
  bytes_ = bytes;
  left_ = count;
  is_read_ = true;
  start();
}

OUT_OF_LINE Twi::State Twi::pump() {
  if (state_ != State::BUSY) return state_;
  if (clocks_) {
    recover();
    return state_;
  }
  if (!(TWCR & _BV(TWINT))) return state_;
  switch (TWSR & TW_STATUS_MASK) {
    case TW_START:
      TWDR = static_cast<uint8_t>(device_ << 1);
      TWCR = _BV(TWINT) | _BV(TWEN);
      break;
    case TW_MT_SLA_ACK:
      TWDR = at_;
      TWCR = _BV(TWINT) | _BV(TWEN);
      break;
    case TW_MT_DATA_ACK:
      if (is_read_) {
        TWCR = _BV(TWINT) | _BV(TWSTA) | _BV(TWEN);
      } else if (left_) {
        left_ = 0;
        TWDR = value_;
        TWCR = _BV(TWINT) | _BV(TWEN);
      } else {
        TWCR = _BV(TWINT) | _BV(TWSTO) | _BV(TWEN);
        state_ = State::DONE;
      }
      break;
    case TW_REP_START:
      TWDR = static_cast<uint8_t>(device_ << 1 | 1);
      TWCR = _BV(TWINT) | _BV(TWEN);
      break;
    case TW_MR_SLA_ACK:
      TWCR = _BV(TWINT) | _BV(TWEN) | (left_ > 1 ? _BV(TWEA) : 0);
      break;
    case TW_MR_DATA_ACK:
      *bytes_++ = TWDR;
      left_--;
      TWCR = _BV(TWINT) | _BV(TWEN) | (left_ > 1 ? _BV(TWEA) : 0);
      break;
    case TW_MR_DATA_NACK:
      *bytes_ = TWDR;
      TWCR = _BV(TWINT) | _BV(TWSTO) | _BV(TWEN);
      state_ = State::DONE;
      break;
    default:
      TWCR = _BV(TWINT) | _BV(TWSTO) | _BV(TWEN);
      state_ = State::FAILED;
      break;
  }
  return state_;
}

void Twi::abandon() {
  TWCR = 0;
  DDRC &= static_cast<uint8_t>(~(SDA | SCL));
  clocks_ = 0;
  state_ = State::FAILED;
}

}  // namespace raspilot
