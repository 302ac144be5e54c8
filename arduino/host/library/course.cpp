#include "course.h"

#include <ucontext.h>

#include "avr/io.h"
#include "hardware.h"

namespace host {

namespace {

/** 16K cycles and 65 ms: SUT of the Nano and the Uno (data sheet 9.3). */
constexpr Cycles START_UP = 66000 * PER_US;
constexpr uint32_t STACK_SIZE = 256 * 1024;

enum Leave { AT_MOMENT, FOR_SAMPLE, BITTEN };

alignas(16) char stack[STACK_SIZE];
ucontext_t firmware_place;
ucontext_t caller_place;
Leave leave_reason;
Cycles time_now;
Cycles moment_to_stop;
Cycles reset_until;
uint8_t wanted_causes = _BV(PORF);
bool is_started;

void leave(Leave reason) {
  leave_reason = reason;
  swapcontext(&firmware_place, &caller_place);
}

void move_to(Cycles moment) {
  time_now = moment;
  run_hardware(moment);
}

/** The chip's immediate actions at a reset; then it waits for START_UP. */
void begin_reset() {
  MCUSR = wanted_causes & _BV(PORF) ? _BV(PORF) : static_cast<uint8_t>(MCUSR | wanted_causes);
  wanted_causes = 0;
  is_started = false;
  reset_until = time_now + START_UP;
  reset_hardware(time_now);
}

void start() {
  reset_until = 0;
  is_started = true;
  getcontext(&firmware_place);
  firmware_place.uc_stack.ss_sp = stack;
  firmware_place.uc_stack.ss_size = sizeof stack;
  firmware_place.uc_link = nullptr;
  makecontext(&firmware_place, run_firmware, 0);
}

}  // namespace

Cycles now() { return time_now; }

void pass(Cycles duration) {
  const Cycles end = time_now + duration;
  while (end >= moment_to_stop) {
    move_to(moment_to_stop);
    leave(AT_MOMENT);
  }
  move_to(end);
  if (has_watchdog_bitten(end)) leave(BITTEN);
}

void await_sample() { leave(FOR_SAMPLE); }

Stop run_until(Cycles moment) {
  moment_to_stop = moment;
  while (time_now < moment) {
    if (wanted_causes) begin_reset();
    if (!is_started) {
      move_to(reset_until < moment ? reset_until : moment);
      if (time_now < reset_until) break;
      start();
    }
    swapcontext(&caller_place, &firmware_place);
    if (leave_reason == FOR_SAMPLE) return WANTS_SAMPLE;
    if (leave_reason == BITTEN) wanted_causes = _BV(WDRF);
  }
  return REACHED;
}

void want_reset(uint8_t causes) { wanted_causes = static_cast<uint8_t>(wanted_causes | causes); }

bool is_in_reset() { return !is_started; }

}  // namespace host
