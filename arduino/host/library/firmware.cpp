/** The firmware as the chip starts it: these sources of src/chip are the ones that fly. */
#include <new>

#include "hardware.h"

// The chip's start-up runs such a function in between; here it is called.
#define naked
#include "chip/machine.cpp"
#include "chip/reset.cpp"
#include "chip/uart.cpp"
#undef naked

void setup();
void loop();

namespace host {

namespace {

/** As start-up makes an object: zero, then constructed. */
template <class Object>
void renew(Object& object) {
  object.~Object();
  new (&object) Object();
}

/** Variables outlive no reset but those of `.noinit`. */
void clear_memory() {
  using namespace raspilot;
  renew(autopilot);
  renew(machine::imu);
  renew(machine::servos);
  machine::due_us = 0;
  machine::slots_to_keep = machine::slots_without_work = machine::slots_to_blink = 0;
  machine::is_next_sample_due = false;
  uart::rx_head = uart::rx_tail = uart::tx_head = uart::tx_tail = 0;
  reset::overflows_without_slot = 0;
}

}  // namespace

void run_firmware() {
  raspilot::reset::raspilot_start_watchdog();
  clear_memory();
  setup();
  for (;;) loop();
}

}  // namespace host
