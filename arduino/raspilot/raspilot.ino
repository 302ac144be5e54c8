// The firmware of Raspilot's Arduino; see docs/firmware.md. Everything lies in src/, the chip's part in src/chip.
#include "src/chip/machine.h"

void setup() { raspilot::machine::setup(); }

void loop() { raspilot::machine::run_slot(); }
