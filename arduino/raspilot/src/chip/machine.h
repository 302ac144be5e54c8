/** The whole firmware on its chip: setup and the slot of 2000 us, 500 times a second. */
#pragma once

namespace raspilot {
namespace machine {

/** Takes the chip over from the Arduino core and starts everything; never waits. */
void setup();

/**
 * One slot: control first, then serial line and other background work, last the IMU's transfer,
 * so that its sample is ready when the next slot begins.
 */
void run_slot();

}  // namespace machine
}  // namespace raspilot
