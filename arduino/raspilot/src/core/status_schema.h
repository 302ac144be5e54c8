/** Codes of the serial line and layout of the status message.
 *  Generated from schema/status.yml by tools/schema.py; do not edit. */
#pragma once

#include <stdint.h>

namespace raspilot {

constexpr uint8_t PROTOCOL_VERSION = 1;
constexpr uint8_t STATUS_SIZE = 23;

/** Flight modes by their letter on the wire. */
enum class Mode : char {
  ACRO = 'a',
  RATE = 'r',
  FBW = 'f',
  SETPOINT = 's',
  RETURN = 'R',
  OUTPUT = 'u'
};

/** Refusals of a Command. */
enum class Reason : uint8_t {
  NONE = 0,
  UNKNOWN_TYPE = 1,
  WRONG_SIZE = 2,
  OUT_OF_RANGE = 3,
  ONLY_ON_GROUND = 4,
  TOO_OLD = 6,
  NOT_AT_AUTO = 7,
  THROTTLE_NOT_LOW = 8,
  RECEIVER_INVALID = 9,
  IMU_INVALID = 10,
  VETO = 11,
  NOT_STILL = 12,
  NOT_ALLOWED = 14,
  NOT_IN_FAILSAFE = 15,
  BATTERY_NOT_MEASURED = 16
};

/** Veto bits of the status. */
enum Veto : uint8_t {
  VETO_THROTTLE_NOT_LOW = 1,
  VETO_RECEIVER_INVALID = 2,
  VETO_IMU_INVALID = 4,
  VETO_AUX2_LOW = 8,
  VETO_RASPBERRY_PI = 16,
  VETO_CALIBRATING = 32,
  VETO_PROFILE_INVALID = 64
};

/** Reset cause bits. */
enum ResetCause : uint8_t {
  RESET_POWER_ON = 1,
  RESET_EXTERNAL = 2,
  RESET_BROWN_OUT = 4,
  RESET_WATCHDOG = 8,
  RESET_RESTORED = 128
};

/** Flags of the status. */
enum StatusFlag : uint8_t {
  FLAG_ARMED = 1,
  FLAG_AT_AUTO = 2,
  FLAG_RECEIVER_VALID = 4,
  FLAG_IMU_VALID = 8,
  FLAG_FAILSAFE = 16,
  FLAG_BIAS_STORED = 32,
  FLAG_GAINS_STORED = 64,
  FLAG_PI_RECEIVED = 128
};

/** Offsets of the fields, big-endian. */
enum StatusOffset : uint8_t {
  AT_VERSION = 0,
  AT_MODE = 1,
  AT_SWITCH = 2,
  AT_FLAGS = 3,
  AT_VETOES = 4,
  AT_RESET_CAUSE = 5,
  AT_LOOP_US = 6,
  AT_LATE_US = 8,
  AT_FRAME_ERRORS = 10,
  AT_FRAMES_LOST = 12,
  AT_UPTIME_S = 14,
  AT_RX_AGE_MS = 16,
  AT_IMU_AGE_MS = 18,
  AT_BATTERY_MV = 20,
  AT_ACCELERATION = 22
};

}  // namespace raspilot
