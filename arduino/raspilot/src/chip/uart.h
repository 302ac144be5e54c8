/** The serial line to the Raspberry Pi: USART0, 8N1 (data sheet 20). */
#pragma once

#include <stdint.h>

namespace raspilot {
namespace uart {

void begin();

/** Takes the oldest byte received; false without one. */
bool read(uint8_t& byte);
/** Whether the oldest byte received is zero: in checked framing it ends a frame. */
bool is_next_zero();

}  // namespace uart
}  // namespace raspilot
