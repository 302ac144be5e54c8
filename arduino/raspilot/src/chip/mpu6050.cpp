#include "mpu6050.h"

#include "../core/compiler.h"
#include "../core/flash.h"

namespace raspilot {

static constexpr uint8_t DEVICE = 0x68;
static constexpr uint8_t IDENTITY = 0x68;

static constexpr uint8_t SMPLRT_DIV = 25;
static constexpr uint8_t CONFIG = 26;
static constexpr uint8_t GYRO_CONFIG = 27;
static constexpr uint8_t ACCEL_CONFIG = 28;
static constexpr uint8_t INT_ENABLE = 56;
static constexpr uint8_t ACCEL_XOUT_H = 59;
static constexpr uint8_t PWR_MGMT_1 = 107;
static constexpr uint8_t REGISTER_WHO_AM_I = 117;

/** DEVICE_RESET; the register map requires 100 ms after it. */
static constexpr uint8_t RESET = 0x80;
static constexpr uint8_t RESET_SLOTS = 50;
/** PWR_MGMT_1 on the gyro's clock; 0x40, asleep, after power-on. */
static constexpr uint8_t AWAKE = 0x01;
/** After a failure to set it up. */
static constexpr uint8_t RETRY_SLOTS = 5;
/** Start-up of the gyro: 30 ms (data sheet 6.1). */
static constexpr uint8_t START_SLOTS = 20;
static constexpr uint8_t FROZEN_SAMPLES = 25;

struct Setting {
  uint8_t at;
  uint8_t value;
};

/** Awake first; then 1 kHz, 98 Hz, +-1000 deg/s, +-8 g, no interrupt. */
static const Setting SETTINGS[] PROGMEM = {
    {PWR_MGMT_1, AWAKE}, {SMPLRT_DIV, 0},      {CONFIG, 2},
    {GYRO_CONFIG, 0x10}, {ACCEL_CONFIG, 0x10}, {INT_ENABLE, 0},
};

void Mpu6050::begin() {
  is_resetting_ = false;
  is_set_up_ = false;
  start_over(0);
}

OUT_OF_LINE void Mpu6050::start_over(uint8_t rest_slots) {
  step_ = FREE_BUS;
  rest_slots_ = rest_slots;
  equals_ = 0;
}

void Mpu6050::begin_transfer() {
  is_transferring_ = rest_slots_ == 0;
  if (!is_transferring_) {
    rest_slots_--;
  } else if (step_ == FREE_BUS) {
    twi_.begin_recovery();
  } else if (step_ == WHO_AM_I) {
    twi_.begin_read(DEVICE, REGISTER_WHO_AM_I, bytes_, 1);
  } else if (is_resetting_) {
    twi_.begin_write(DEVICE, PWR_MGMT_1, RESET);
  } else if (step_ == POWER) {
    twi_.begin_read(DEVICE, PWR_MGMT_1, bytes_, 1);
  } else if (step_ < READY) {
    const Setting* const setting = &SETTINGS[step_ - SETUP];
    twi_.begin_write(DEVICE, pgm_read_byte(&setting->at), pgm_read_byte(&setting->value));
  } else {
    twi_.begin_read(DEVICE, ACCEL_XOUT_H, bytes_, sizeof bytes_);
  }
}

void Mpu6050::end_transfer() {
  has_sample_ = false;
  if (!is_transferring_) return;
  is_transferring_ = false;
  if (twi_.state() == Twi::State::DONE) {
    on_success();
  } else {
    twi_.abandon();
    start_over(step_ == READY ? 0 : RETRY_SLOTS);
  }
}

void Mpu6050::on_success() {
  static_assert(sizeof SETTINGS / sizeof *SETTINGS == SETTINGS_COUNT, "a step for each setting");
  if (step_ == READY) {
    take_sample();
  } else if (step_ == WHO_AM_I) {
    on_identity();
  } else if (step_ == POWER) {
    on_power();
  } else {
    step_++;
    if (step_ != READY) return;
    is_set_up_ = true;
    if (!is_awake_) rest_slots_ = START_SLOTS;
  }
}

void Mpu6050::on_identity() {
  if (bytes_[0] == IDENTITY)
    step_ = POWER;
  else
    start_over(RETRY_SLOTS);
}

void Mpu6050::on_power() {
  if (is_resetting_) {
    is_resetting_ = false;
    start_over(RESET_SLOTS);
    return;
  }
  is_awake_ = bytes_[0] == AWAKE;
  // One that has slept has forgotten its settings, also when it is woken before all are written.
  if (!is_awake_) is_set_up_ = false;
  step_ = is_set_up_ ? READY : SETUP;
}

void Mpu6050::take_sample() {
  static_assert(sizeof sample_ == sizeof bytes_, "seven numbers in the order of the registers");
  uint16_t* const values = reinterpret_cast<uint16_t*>(&sample_);
  uint16_t sum = 0;
  for (uint8_t i = 0; i < 7; i++) {
    values[i] = __builtin_bswap16(values[i]);
    sum = sum * 3 + values[i];
  }
  has_sample_ = true;
  equals_ = sum == sum_ ? static_cast<uint8_t>(equals_ + 1) : 0;
  sum_ = sum;
  if (equals_ < FROZEN_SAMPLES) return;
  is_resetting_ = true;
  start_over(0);
}

}  // namespace raspilot
