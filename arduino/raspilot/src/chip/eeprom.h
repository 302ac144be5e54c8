/** The 1024 bytes of EEPROM (data sheet 8.4). */
#pragma once

namespace raspilot {
namespace eeprom {

/** Waits, at most 10 ms, for a write that a reset left going on. */
void begin();

}  // namespace eeprom
}  // namespace raspilot
