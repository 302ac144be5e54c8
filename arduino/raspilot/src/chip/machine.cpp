#include "machine.h"

#include <avr/interrupt.h>
#include <avr/io.h>

#include "../core/autopilot.h"
#include "clock.h"
#include "edges.h"
#include "eeprom.h"
#include "mpu6050.h"
#include "pins.h"
#include "reset.h"
#include "servos.h"
#include "uart.h"

namespace raspilot {
namespace machine {

/** The last part of a slot is the IMU's: 17 bytes of 22.5 us, and what interrupts take. */
static constexpr int16_t IMU_TICKS = 2 * 550;
static constexpr int16_t TRANSFER_TICKS = 2 * 430;
static constexpr int16_t GRACE_TICKS = 2 * 60;
/** A background piece begins only if it ends before that. */
static constexpr int16_t PIECE_TICKS = 2 * 110;
static constexpr int16_t KEEP_TICKS = 2 * 270;
static constexpr int16_t BYTE_TICKS = 2 * 20;
/** State is kept 50 times a second. */
static constexpr uint8_t KEEP_SLOTS = 10;
/** The LED changes each half second while all is well, ten times faster while the IMU is not. */
static constexpr uint8_t SLOW_LED_SLOTS = 250;
static constexpr uint8_t FAST_LED_SLOTS = 25;

static Autopilot autopilot;
static Mpu6050 imu;
static Servos servos;
static uint32_t due_us;
static uint8_t slots_to_keep;
static uint8_t slots_to_blink;

void setup() {
  cli();
  ADCSRA = 0;
  clock::begin();
  uart::begin();
  edges::begin();
  servos.begin();
  eeprom::begin();
  imu.begin();
  DDRB |= bit_on_b(PIN_LED);
  sei();
  SavedState state;
  const bool is_restored = reset::restore(state);
  autopilot.begin(is_restored ? &state : nullptr, reset::cause(), clock::now_us());
  autopilot.link.open();
  due_us = clock::now_us();
}

static int16_t ticks_until(uint16_t moment) {
  return static_cast<int16_t>(moment - clock::ticks());
}

static void blink() {
  if (autopilot.authority.is_armed()) {
    PORTB |= bit_on_b(PIN_LED);
  } else if (slots_to_blink) {
    slots_to_blink--;
  } else {
    slots_to_blink = autopilot.attitude.is_valid() ? SLOW_LED_SLOTS : FAST_LED_SLOTS;
    PINB = bit_on_b(PIN_LED);
  }
}

/** One piece of background work that ends in `left` ticks; false when there is none. */
static bool work(int16_t left) {
  uint8_t byte;
  if (left < BYTE_TICKS) return false;
  if (uart::read(byte)) {
    autopilot.link.on_byte(byte, clock::now_us());
    return true;
  }
  if (!slots_to_keep && left >= KEEP_TICKS) {
    slots_to_keep = KEEP_SLOTS;
    reset::keep(autopilot.state());
    return true;
  }
  if (left < PIECE_TICKS) return false;
  return autopilot.background(clock::now_us());
}

void run_slot() {
  const uint32_t now = clock::now_us();
  autopilot.meter.on_slot(due_us, now);
  edges::drain(autopilot.receiver, now);
  servos.plan(autopilot.receiver);
  autopilot.control(imu.sample(), now);
  servos.set(autopilot.controller.outputs());
  blink();
  if (slots_to_keep) slots_to_keep--;

  due_us += SLOT_US;
  const uint16_t due_ticks = static_cast<uint16_t>(due_us * 2);
  int16_t left;
  do {
    left = ticks_until(static_cast<uint16_t>(due_ticks - IMU_TICKS));
  } while (left > 0 && (work(left), true));
  // A slot that left too little time goes without a sample; a transfer that is near its end ends.
  if (ticks_until(due_ticks) >= TRANSFER_TICKS) imu.begin_transfer();
  while (imu.pump() && ticks_until(due_ticks) > -GRACE_TICKS) {
  }
  imu.end_transfer();
  while (ticks_until(due_ticks) > 0) {
  }

  // A slot that took several is not made up for: time goes on from here.
  const uint32_t end = clock::now_us();
  if (static_cast<int32_t>(end - due_us) > SLOT_US) due_us = end;
  reset::feed();
}

}  // namespace machine
}  // namespace raspilot
