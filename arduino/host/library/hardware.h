/** The chip's hardware and the parts wired to it, each in a separate file. */
#pragma once

#include <stdint.h>

#include "course.h"
#include "host_board.h"

namespace host {

/** The caller's view, and the place of its samples. */
extern host_board_view view;
inline double to_us(Cycles moment) { return static_cast<double>(moment) / PER_US; }

/** Advances every part to a moment; called whenever time has moved on. */
void run_hardware(Cycles moment);
/** Resets the parts; MCUSR has the cause. */
void reset_hardware(Cycles moment);
bool has_watchdog_bitten(Cycles moment);

/** Everything of src that is static, as start-up clears it, then the sketch. Never returns. */
void run_firmware();

namespace timer {
/** Timer1 of 0.5 us, unwrapped: half microseconds since it was started. */
int64_t ticks_at(Cycles moment);
Cycles cycles_at(int64_t ticks);
void run(Cycles moment);
void reset();
}  // namespace timer

namespace receiver {
void begin(Cycles first_frame);
void set(uint8_t channel, double width_us);
void set_on(bool is_on);
void set_channel(uint8_t channel, bool is_on);
void run(Cycles moment);
void reset();
}  // namespace receiver

namespace servos {
void run(Cycles moment);
void reset(Cycles moment);
}  // namespace servos

namespace line {
void write(const uint8_t* bytes, uint32_t size);
uint32_t read(uint8_t* into, uint32_t size);
void run(Cycles moment);
void reset();
}  // namespace line

namespace memory {
void begin(const uint8_t* bytes, uint32_t size, uint32_t seed);
void run(Cycles moment);
/** Power fails: a cell being written gets any value. */
void cut();
}  // namespace memory

namespace sensor {
enum Fault : uint8_t { WELL, UNPLUGGED, STUCK };
void set_fault(Fault fault);
bool is_stuck();
/** Whether it is there and awake enough to answer its address. */
bool answers();
void write(uint8_t at, uint8_t value);
void read(uint8_t at, uint8_t* bytes, uint8_t count);
void power_on();
}  // namespace sensor

}  // namespace host
