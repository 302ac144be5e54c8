/** The 1024 bytes of EEPROM (data sheet 8.4). */
#pragma once

namespace raspilot {
namespace eeprom {

/** Waits, at most 10 ms, for a write still in progress after a reset. */
void begin();

}  // namespace eeprom
}  // namespace raspilot
