#include "hardware.h"

#include "avr/io.h"
#include "avr/wdt.h"

uint8_t SREG, MCUSR, ADMUX, ADCSRA, DDRB, PORTB, PINB, GPIOR0, GPIOR1, TCNT2, PCIFR;
uint8_t UCSR0A, UCSR0B, UCSR0C, UDR0;
uint16_t UBRR0, ADC;

namespace {

constexpr host::Cycles MIN_WATCHDOG = 16000 * host::PER_US;

host::Cycles watchdog_time;
host::Cycles watchdog_due = host::NEVER;

}  // namespace

void wdt_enable(uint8_t time) {
  watchdog_time = MIN_WATCHDOG << time;
  wdt_reset();
}

void wdt_reset() { watchdog_due = host::now() + watchdog_time; }

namespace host {

bool has_watchdog_bitten(Cycles moment) { return moment >= watchdog_due; }

void run_hardware(Cycles moment) {
  receiver::run(moment);
  servos::run(moment);
  line::run(moment);
  memory::run(moment);
  timer::run(moment);
}

void reset_hardware(Cycles moment) {
  watchdog_due = NEVER;
  SREG = UCSR0B = 0;
  if (MCUSR & (_BV(PORF) | _BV(BORF))) {
    memory::cut();
    sensor::power_on();
  }
  receiver::reset();
  servos::reset(moment);
  line::reset();
  timer::reset();
}

}  // namespace host
