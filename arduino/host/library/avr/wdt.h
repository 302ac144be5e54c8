/** The watchdog's times (data sheet 10.9.2) and its reset. */
#pragma once

#include <stdint.h>

enum WatchdogTime { WDTO_120MS = 3 };

/** It bites 16 ms times two to the power of `time` after it was fed last. */
void wdt_enable(uint8_t time);
void wdt_reset();
