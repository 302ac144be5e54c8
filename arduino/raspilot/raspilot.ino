// The firmware of Raspilot's Arduino (docs/firmware.md). All of it lies in src/.
#include "src/chip/machine.h"

void setup() { raspilot::machine::setup(); }

void loop() { raspilot::machine::run_slot(); }
