/**
 * The firmware with its board, for a program that loads it: plain C. A process has as many boards
 * as it loads copies of this library. Times are microseconds since the first power-on; channels
 * are 0 to 5 in the order of the wire.
 */
#pragma once

#include <stdint.h>

#pragma GCC visibility push(default)
#ifdef __cplusplus
extern "C" {
#endif

/** The version of this interface. */
uint32_t host_board_version(void);

/** Power-on. `eeprom` are its first bytes, the rest is erased. Once, before all others. */
void host_board_begin(const uint8_t* eeprom, uint32_t size, uint32_t seed, double first_frame_us);
/** Runs to a time: 0 when it is reached, 1 when `sample` is to be filled in before it runs on. */
int host_board_run(double until_us);
/** A reset by bits of MCUSR: 1 power, 2 button, 4 brown-out, 8 watchdog. */
void host_board_reset(uint8_t cause);

void host_board_set_stick(uint8_t channel, double width_us);
void host_board_set_receiver(int is_on);
void host_board_set_channel(uint8_t channel, int is_on);

/** Data shared by the board and its caller. */
typedef struct {
  double now_us;
  /** The newest pulse of each servo, 0 before the first, and when it ended. */
  double width_us[4];
  double ended_us[4];
  /** Time of the requested IMU sample, and the firmware's settings of the IMU. */
  double sample_us;
  uint8_t imu_registers[128];
  /** The sample, as the registers hold it: accelerometer, temperature, gyro. */
  int16_t sample[7];
  uint8_t eeprom[1024];
} host_board_view;
/** The pointer stays valid. */
host_board_view* host_board_get_view(void);

/** Bytes to the firmware, each when the one before has ended; from it, how many were copied. */
void host_board_write(const uint8_t* bytes, uint32_t size);
uint32_t host_board_read(uint8_t* into, uint32_t size);

/** The voltage at pin A7, from 0 on. */
void host_board_set_a7(double volts);

/** The IMU: 0 well, 1 unplugged, 2 holding its bus. */
void host_board_set_imu_fault(uint8_t fault);

#ifdef __cplusplus
}
#endif
#pragma GCC visibility pop
