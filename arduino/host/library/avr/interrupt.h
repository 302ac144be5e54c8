/** Interrupts: the hardware of this folder calls their routines while the firmware's time passes. */
#pragma once

#include "io.h"

#define ISR(vector) extern "C" void vector()

inline void cli() { SREG = static_cast<uint8_t>(SREG & ~_BV(SREG_I)); }
inline void sei() { SREG = static_cast<uint8_t>(SREG | _BV(SREG_I)); }
