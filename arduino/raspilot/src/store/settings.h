/**
 * Profile, gains, calibration and the battery's scale: the active values, and two CRC'd copies of
 * each in EEPROM.
 *
 * Each kind has two slots; the newer valid one is loaded, a save goes into the other, byte by byte
 * in the background, so that a power cut leaves the older. Saving waits while armed.
 */
#pragma once

#include "../protocol/crc16.h"
#include "calibration.h"
#include "gains.h"
#include "profile.h"

namespace raspilot {

constexpr uint8_t BATTERY_SIZE = 2;

class Settings {
 public:
  Profile profile;
  Gains gains;
  Calibration calibration;
  /** The flight battery's voltage at which A7 has 1.1 V; 0: no divider. */
  uint16_t battery_full_scale_mv;

  /** Reads EEPROM; missing or damaged values become the defaults. */
  void load();
  /**
   * Marks a kind for saving; saving begins at the next background() while disarmed. A kind that
   * changes during its save is marked again and the save restarts.
   */
  void save_profile() { save(PROFILE); }
  void save_gains() { save(GAINS); }
  void save_calibration() { save(CALIBRATION); }
  void save_battery() { save(BATTERY); }
  /**
   * Writes or checks at most one byte of EEPROM; never waits; false when there is nothing to do
   * now. A save that arming interrupts, or whose slot does not read back, restarts.
   */
  bool background(bool is_armed);
  bool is_saving() const;

  /** Whether a valid copy is in EEPROM (gains: status flag bit 6). */
  bool has_gains() const { return kinds_[GAINS].is_stored; }
  bool has_calibration() const { return kinds_[CALIBRATION].is_stored; }
  /**
   * EEPROM held a kind and no copy of it can be read: arming veto bit 6. The battery's scale does
   * not count: without it the voltage is unknown.
   */
  bool is_broken() const;

 private:
  enum Kind : uint8_t { PROFILE, GAINS, CALIBRATION, BATTERY, KINDS };

  struct KindState {
    bool is_pending;
    bool is_stored;
    bool is_broken;
    /** Where the newest copy lies, and its sequence. */
    uint8_t slot;
    uint8_t sequence;
  };

  void load_kind(Kind kind);
  void save(Kind kind);
  void begin_save();
  void step();
  void fail();
  void finish();
  uint8_t next_byte();
  bool is_kept() const;
  uint16_t target() const;
  bool is_at_end() const;
  bool apply(Kind kind, const uint8_t* data);
  void fill(uint8_t* data) const;

  // load() sets all of these: nothing is to be done before it.
  KindState kinds_[KINDS];
  /** The kind that is being saved, if any is pending. */
  Kind kind_;
  /** Reads the written bytes back. */
  bool is_checking_;
  uint8_t offset_;
  uint8_t attempts_;
  Crc16 crc_;
};

}  // namespace raspilot
