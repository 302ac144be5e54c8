/**
 * Profile, gains and calibration: what flies now, and its two CRC'd copies each in EEPROM.
 *
 * Each kind has two slots; the newer valid one is loaded, a save goes into the other, byte by byte
 * in the background, so that a power cut leaves the older. Saving waits while armed.
 */
#pragma once

#include "calibration.h"
#include "gains.h"
#include "profile.h"

namespace raspilot {

class Settings {
 public:
  Profile profile;
  Gains gains;
  Calibration calibration;

  /** Reads EEPROM; what is missing or broken becomes the default. */
  void load();
  /** Marks a kind for saving; saving begins at the next background() while disarmed. */
  void save_profile();
  void save_gains();
  void save_calibration();
  /** Writes at most one byte of EEPROM; never waits. */
  void background(bool is_armed);
  bool is_saving() const;

  /** Whether a valid copy is in EEPROM (gains: status flag bit 6). */
  bool has_gains() const;
  bool has_calibration() const;
  /** EEPROM held a profile and no copy of it can be read: arming veto bit 6. */
  bool is_profile_broken() const;
};

}  // namespace raspilot
