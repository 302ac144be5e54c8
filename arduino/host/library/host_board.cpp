#include "host_board.h"

#include <math.h>

#include "avr/io.h"
#include "hardware.h"

namespace host {

host_board_view view = {0, {}, {-INFINITY, -INFINITY, -INFINITY, -INFINITY}, 0, {}, {}, {}};

}  // namespace host

namespace {

host::Cycles cycles(double time_us) { return llround(time_us * host::PER_US); }

}  // namespace

extern "C" {

uint32_t host_board_version(void) { return 2; }

void host_board_begin(const uint8_t* eeprom, uint32_t size, uint32_t seed, double first_frame_us) {
  host::memory::begin(eeprom, size, seed);
  host::receiver::begin(cycles(first_frame_us));
}

int host_board_run(double until_us) {
  const host::Stop stop = host::run_until(cycles(until_us));
  host::view.now_us = host::to_us(host::now());
  return stop;
}

void host_board_reset(uint8_t cause) { host::want_reset(cause); }

void host_board_set_stick(uint8_t channel, double width_us) {
  host::receiver::set(channel, width_us);
}

void host_board_set_receiver(int is_on) { host::receiver::set_on(is_on); }

void host_board_set_channel(uint8_t channel, int is_on) {
  host::receiver::set_channel(channel, is_on);
}

host_board_view* host_board_get_view(void) { return &host::view; }

void host_board_write(const uint8_t* bytes, uint32_t size) { host::line::write(bytes, size); }

uint32_t host_board_read(uint8_t* into, uint32_t size) { return host::line::read(into, size); }

void host_board_set_a7(double volts) {
  // The result of the conversion that is always over.
  ADC = static_cast<uint16_t>(fmin(volts / 1.1 * 1024, 1023));
}

void host_board_set_imu_fault(uint8_t fault) {
  host::sensor::set_fault(static_cast<host::sensor::Fault>(fault));
}
}
