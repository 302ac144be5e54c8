/**
 * The wiring, as the numbers printed on the board (A0 is 14); docs/wiring.md.
 *
 * D0 and D1 are the serial line, A4 and A5 the IMU's bus on either board.
 */
#pragma once

#include <stdint.h>

namespace raspilot {

#ifdef RASPILOT_PROTOTYPE_BOARD
/** The thesis's board (attachment 3): its servo pins have no timer. */
constexpr uint8_t PIN_RX_AILERONS = 8;
constexpr uint8_t PIN_RX_ELEVATOR = 9;
constexpr uint8_t PIN_RX_THROTTLE = 6;
constexpr uint8_t PIN_RX_RUDDER = 10;
constexpr uint8_t PIN_RX_AUX1 = 11;
constexpr uint8_t PIN_RX_AUX2 = 12;
constexpr uint8_t PIN_SERVO_AILERONS = 17;
constexpr uint8_t PIN_SERVO_ELEVATOR = 16;
constexpr uint8_t PIN_SERVO_RUDDER = 14;
constexpr uint8_t PIN_ESC_THROTTLE = 15;
#else
/** All four outputs are pins of Timer1 and Timer2; five of the six inputs share a port. */
constexpr uint8_t PIN_RX_AILERONS = 2;
constexpr uint8_t PIN_RX_ELEVATOR = 4;
constexpr uint8_t PIN_RX_THROTTLE = 5;
constexpr uint8_t PIN_RX_RUDDER = 6;
constexpr uint8_t PIN_RX_AUX1 = 7;
constexpr uint8_t PIN_RX_AUX2 = 8;
constexpr uint8_t PIN_SERVO_AILERONS = 9;
constexpr uint8_t PIN_SERVO_ELEVATOR = 10;
constexpr uint8_t PIN_SERVO_RUDDER = 11;
constexpr uint8_t PIN_ESC_THROTTLE = 3;
#endif
constexpr uint8_t PIN_LED = 13;
/** A7, which has no port. */
constexpr uint8_t PIN_BATTERY = 21;

/** The pin's bit in its port: D0 to D7 are port D, D8 to D13 port B, A0 to A5 port C. */
constexpr uint8_t pin_bit(uint8_t pin) {
  return static_cast<uint8_t>(1 << (pin < 8 ? pin : pin < 14 ? pin - 8 : pin - 14));
}
constexpr uint8_t bit_on_d(uint8_t pin) { return pin < 8 ? pin_bit(pin) : 0; }
constexpr uint8_t bit_on_b(uint8_t pin) { return pin >= 8 && pin < 14 ? pin_bit(pin) : 0; }
constexpr uint8_t bit_on_c(uint8_t pin) { return pin >= 14 ? pin_bit(pin) : 0; }

}  // namespace raspilot
