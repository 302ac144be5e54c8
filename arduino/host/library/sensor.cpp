/** The MPU6050 at its bus (register map RM-MPU-6000A-00, 4.2), and the bus: a byte takes 26 us. */
#include <string.h>

#include "chip/twi.h"
#include "hardware.h"

namespace host {
namespace sensor {

namespace {

enum Register { SMPLRT_DIV = 25, CONFIG = 26, ACCEL_XOUT_H = 59, PWR_MGMT_1 = 107, WHO_AM_I = 117 };
constexpr uint8_t IN_RESET = 0x80;
constexpr uint8_t ASLEEP = 0x40;
constexpr uint8_t IDENTITY = 0x68;
constexpr uint8_t NUMBERS = 7;
/** Until it answers after power-on (PS-MPU-6000A-00, 6.3). */
constexpr Cycles START_UP = 20000 * PER_US;

uint8_t* const registers = view.imu_registers;
Fault fault = WELL;
Cycles ready;
Cycles epoch;
Cycles sampled = -1;

void to_defaults() {
  memset(registers, 0, sizeof view.imu_registers);
  registers[PWR_MGMT_1] = ASLEEP;
  registers[WHO_AM_I] = IDENTITY;
  sampled = -1;
}

Cycles period() {
  const uint8_t filter = registers[CONFIG] & 7;
  const Cycles rate_hz = filter == 0 || filter == 7 ? 8000 : 1000;
  return 1000000 * PER_US / rate_hz * (registers[SMPLRT_DIV] + 1);
}

/** Takes the newest sample if there is one since the last look. */
void refresh() {
  if (registers[PWR_MGMT_1] & ASLEEP) return;
  const Cycles newest = now() - (now() - epoch) % period();
  if (newest <= sampled) return;
  sampled = newest;
  view.sample_us = to_us(newest);
  await_sample();
  for (uint8_t i = 0; i < NUMBERS; ++i) {
    const uint16_t number = static_cast<uint16_t>(view.sample[i]);
    registers[ACCEL_XOUT_H + 2 * i] = static_cast<uint8_t>(number >> 8);
    registers[ACCEL_XOUT_H + 2 * i + 1] = static_cast<uint8_t>(number);
  }
}

}  // namespace

void set_fault(Fault now_has) {
  if (fault == UNPLUGGED && now_has != UNPLUGGED) power_on();
  fault = now_has;
}

bool is_stuck() { return fault == STUCK; }

bool answers() { return fault == WELL && now() >= ready; }

void write(uint8_t at, uint8_t value) {
  if (at == PWR_MGMT_1 && value & IN_RESET) {
    to_defaults();
    return;
  }
  if (at >= WHO_AM_I || (at >= ACCEL_XOUT_H && at < ACCEL_XOUT_H + 2 * NUMBERS)) return;
  registers[at] = value;
  if (at == PWR_MGMT_1 || at == SMPLRT_DIV) epoch = now();
}

void read(uint8_t at, uint8_t* bytes, uint8_t count) {
  if (at >= ACCEL_XOUT_H && at < ACCEL_XOUT_H + 2 * NUMBERS) refresh();
  for (uint8_t i = 0; i < count; ++i) bytes[i] = registers[(at + i) & 127];
}

void power_on() {
  to_defaults();
  ready = now() + START_UP;
}

}  // namespace sensor
}  // namespace host

namespace raspilot {

namespace {

constexpr host::Cycles BYTE = 26 * host::PER_US;
constexpr host::Cycles RECOVERY = 120 * host::PER_US;
/** Longest time between the firmware's reads; within it, a hanging one is given up. */
constexpr host::Cycles LOOK = 60 * host::PER_US;
constexpr uint8_t BYTES_TO_WRITE = 3;
constexpr uint8_t BYTES_TO_READ = 3;

host::Cycles ends;

}  // namespace

void Twi::begin_recovery() {
  clocks_ = 1;
  ends = host::now() + RECOVERY;
  state_ = State::BUSY;
}

void Twi::start() {
  clocks_ = 0;
  const host::Cycles bytes = is_read_ ? BYTES_TO_READ + left_ : BYTES_TO_WRITE;
  // One that does not answer its address ends there; a line that is held low never begins.
  ends = host::now() + BYTE * (host::sensor::answers() ? bytes : 1);
  if (host::sensor::is_stuck()) ends = host::NEVER;
  state_ = State::BUSY;
}

void Twi::begin_write(uint8_t, uint8_t at, uint8_t value) {
  at_ = at;
  value_ = value;
  is_read_ = false;
  start();
}

void Twi::begin_read(uint8_t, uint8_t at, uint8_t* bytes, uint8_t count) {
  at_ = at;
  bytes_ = bytes;
  left_ = count;
  is_read_ = true;
  start();
}

Twi::State Twi::pump() {
  if (state_ != State::BUSY) return state_;
  const host::Cycles left = ends - host::now();
  if (left > 0) host::pass(left < LOOK ? left : LOOK);
  if (host::now() < ends) return state_;
  state_ = State::DONE;
  if (clocks_) return state_;
  if (!host::sensor::answers()) {
    state_ = State::FAILED;
  } else if (is_read_) {
    host::sensor::read(at_, bytes_, left_);
  } else {
    host::sensor::write(at_, value_);
  }
  return state_;
}

void Twi::abandon() { state_ = State::FAILED; }

}  // namespace raspilot
