#include "machine.h"

#include <avr/interrupt.h>
#include <avr/io.h>

#include "../core/autopilot.h"
#include "../core/compiler.h"
#include "clock.h"
#include "edges.h"
#include "eeprom.h"
#include "mpu6050.h"
#include "pins.h"
#include "reset.h"
#include "servos.h"
#include "uart.h"

/**
 * Taken by the linker instead of the Arduino core's, which would start Timer0's interrupt and PWM
 * on all timers.
 */
extern "C" void init() {}

namespace raspilot {

static Autopilot autopilot;

// Sections of their own, which the linker drops: the compiler has the addresses already.
#define ONLY __attribute__((section(".data.only")))
#ifdef __AVR__
template <> Autopilot& Reference<Autopilot>::only ONLY = autopilot;
template <> const Profile& Reference<const Profile>::only ONLY = autopilot.settings.profile;
template <> const Gains& Reference<const Gains>::only ONLY = autopilot.settings.gains;
template <> Calibration& Reference<Calibration>::only ONLY = autopilot.settings.calibration;
template <>
const Calibration& Reference<const Calibration>::only ONLY = autopilot.settings.calibration;
template <> const PwmReader& Reference<const PwmReader>::only ONLY = autopilot.receiver;
#endif

namespace machine {

/** The last part of a slot is the IMU's: 17 bytes of 22.5 us, starts and polling, 465 us in all. */
static constexpr int16_t IMU_TICKS = 2 * 512;
static constexpr int16_t TRANSFER_TICKS = 2 * 460;
static constexpr int16_t GRACE_TICKS = 2 * 470;
/** Before a sample that cannot be given up: what interrupts add to a piece of work. */
static constexpr int16_t RESERVE_TICKS = 2 * 128;
/** Background work begins only when the longest of its kind ends before that. */
static constexpr int16_t PIECE_TICKS = 2 * 560;
static constexpr int16_t KEEP_TICKS = 2 * 340;
static constexpr int16_t BYTE_TICKS = 2 * 150;
static constexpr int16_t COMMAND_TICKS = 2 * 390;
/** After this many slots without background work a slot gives up its sample for it. */
static constexpr uint8_t PATIENT_SLOTS = 5;
/** The pin against the internal 1.1 V; free running at 125 kHz, a conversion takes 0.1 ms. */
static constexpr uint8_t ADC_BATTERY = _BV(REFS1) | _BV(REFS0) | (PIN_BATTERY - 14);
static constexpr uint8_t ADC_RUNS =
    _BV(ADEN) | _BV(ADSC) | _BV(ADATE) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);
/** State is kept, and the battery measured, 50 times a second. */
static constexpr uint8_t KEEP_SLOTS = 10;
/** The LED changes each half second while all is well, ten times faster while the IMU is not. */
static constexpr uint8_t SLOW_LED_SLOTS = 250;
static constexpr uint8_t FAST_LED_SLOTS = 25;

static Mpu6050 imu;
static Servos servos;
static uint32_t due_us;
static uint8_t slots_to_keep;
static uint8_t slots_without_work;
static bool is_next_sample_due;
static uint8_t slots_to_blink;

OUT_OF_LINE void setup() {
  cli();
  ADMUX = ADC_BATTERY;
  ADCSRA = ADC_RUNS;
  clock::begin();
  uart::begin();
  edges::begin();
  servos.begin();
  eeprom::begin();
  imu.begin();
  DDRB |= bit_on_b(PIN_LED);
  sei();
  SavedState state;
  const bool is_kept = reset::restore(state);
  autopilot.begin(is_kept ? &state : nullptr, reset::cause(), clock::now_us());
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

/**
 * The next piece of background work, if it ends in `left` ticks. One piece comes before the line's
 * bytes, the others after them, so that neither starves.
 */
static void work(int16_t left) {
  uint8_t byte;
  // The end of a frame carries its Command out.
  const int16_t byte_ticks = uart::is_next_zero() ? COMMAND_TICKS : BYTE_TICKS;
  if (left >= PIECE_TICKS && slots_without_work) {
    slots_without_work = 0;
    autopilot.background(clock::now_us());
  } else if (left >= byte_ticks && uart::read(byte)) {
    autopilot.link.on_byte(byte, clock::now_us());
  } else if (left >= KEEP_TICKS && !slots_to_keep) {
    slots_to_keep = KEEP_SLOTS;
    autopilot.battery.on_count(ADC);
    reset::keep(autopilot.state());
  } else if (left >= PIECE_TICKS) {
    autopilot.background(clock::now_us());
  }
}

/** Background work until the IMU's time begins. */
static void work_until(uint16_t end_ticks) {
  if (is_next_sample_due) {
    end_ticks -= RESERVE_TICKS;
  } else if (++slots_without_work > PATIENT_SLOTS) {
    end_ticks += IMU_TICKS;
  }
  int16_t left;
  while ((left = ticks_until(end_ticks)) > 0) work(left);
}

/** The IMU's transfer, and the rest of the slot. */
static void read_imu_until(uint16_t due_ticks) {
  // A slot that left too little time goes without a sample, but never two in turn: rather late.
  is_next_sample_due = !is_next_sample_due && ticks_until(due_ticks) < TRANSFER_TICKS;
  if (!is_next_sample_due) imu.begin_transfer();
  while (imu.pump() && ticks_until(due_ticks) > -GRACE_TICKS) {
  }
  imu.end_transfer();
  while (ticks_until(due_ticks) > 0) {
  }
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
  work_until(static_cast<uint16_t>(due_ticks - IMU_TICKS));
  read_imu_until(due_ticks);

  // Missed slots are not made up for: the time continues from here.
  const uint32_t end = clock::now_us();
  if (static_cast<int32_t>(end - due_us) > SLOT_US) due_us = end;
  reset::feed();
}

}  // namespace machine
}  // namespace raspilot
