#include "settings.h"

#include <string.h>

#include "../core/board.h"
#include "../core/compiler.h"
#include "../core/flash.h"
#include "eeprom_slot.h"
#include "wire_bytes.h"

namespace raspilot {

namespace {

/** Version of the stored format. */
constexpr uint8_t VERSION = 1;
/** A cell that will not take its value is given up after this number of saves. */
constexpr uint8_t MAX_ATTEMPTS = 3;
constexpr uint8_t LARGEST_SIZE = GAINS_SIZE;

const uint8_t SIZES[] PROGMEM = {PROFILE_SIZE, GAINS_SIZE, CALIBRATION_SIZE, BATTERY_SIZE};

uint8_t size_of(uint8_t kind) { return pgm_read_byte(&SIZES[kind]); }

/** Sequences go round: the newer of two is ahead by less than half of it. */
bool is_newer(uint8_t sequence, uint8_t than) {
  return static_cast<int8_t>(static_cast<uint8_t>(sequence - than)) > 0;
}

}  // namespace

void Settings::load() {
  memcpy_P(&profile, &DEFAULT_PROFILE, sizeof profile);
  memcpy_P(&gains, &DEFAULT_GAINS, sizeof gains);
  memcpy_P(&calibration, &DEFAULT_CALIBRATION, sizeof calibration);
  battery_full_scale_mv = 0;
  for (uint8_t kind = 0; kind < KINDS; ++kind) load_kind(static_cast<Kind>(kind));
  kind_ = PROFILE;
  begin_save();
}

void Settings::load_kind(Kind kind) {
  KindState& state = kinds_[kind];
  state.is_pending = false;
  state.is_stored = false;
  state.slot = 1;
  state.sequence = 0;
  for (uint8_t slot = 0; slot < SLOTS_A_KIND; ++slot) {
    uint8_t data[LARGEST_SIZE];
    uint8_t sequence;
    if (!read_slot(slot_address(kind, slot), VERSION, size_of(kind), data, sequence)) continue;
    if (state.is_stored && !is_newer(sequence, state.sequence)) continue;
    if (!apply(kind, data)) continue;
    state.is_stored = true;
    state.slot = slot;
    state.sequence = sequence;
  }
  state.is_broken = !state.is_stored && !(is_slot_erased(slot_address(kind, 0)) &&
                                          is_slot_erased(slot_address(kind, 1)));
}

OUT_OF_LINE void Settings::save(Kind kind) {
  kinds_[kind].is_pending = true;
  if (kind == kind_) begin_save();
}

bool Settings::is_broken() const {
  return kinds_[PROFILE].is_broken || kinds_[GAINS].is_broken || kinds_[CALIBRATION].is_broken;
}

bool Settings::is_saving() const {
  return kinds_[PROFILE].is_pending || kinds_[GAINS].is_pending || kinds_[CALIBRATION].is_pending ||
         kinds_[BATTERY].is_pending;
}

bool Settings::background(bool is_armed) {
  if (is_armed) {
    begin_save();
    return false;
  }
  if (!is_saving() || !board::eeprom_is_ready()) return false;
  while (!kinds_[kind_].is_pending) {
    kind_ = static_cast<Kind>(kind_ + 1 == KINDS ? 0 : kind_ + 1);
    begin_save();
  }
  if (offset_ == 0 && !is_checking_ && is_kept()) {
    kinds_[kind_].is_pending = false;
  } else {
    step();
  }
  return true;
}

/** Whether the newest copy already holds the values to be saved: cells of EEPROM wear. */
bool Settings::is_kept() const {
  const KindState& state = kinds_[kind_];
  if (!state.is_stored) return false;
  uint8_t data[LARGEST_SIZE];
  fill(data);
  const uint16_t start = static_cast<uint16_t>(slot_address(kind_, state.slot) + SLOT_HEADER_SIZE);
  for (uint8_t at = 0; at < size_of(kind_); ++at) {
    if (board::eeprom_read(static_cast<uint16_t>(start + at)) != data[at]) return false;
  }
  return true;
}

OUT_OF_LINE void Settings::begin_save() {
  is_checking_ = false;
  offset_ = 0;
  attempts_ = 0;
}

void Settings::step() {
  const uint16_t start = target();
  const uint16_t address = static_cast<uint16_t>(start + offset_);
  if (is_checking_) {
    if (board::eeprom_read(address) != next_byte()) {
      fail();
    } else if (is_at_end()) {
      finish();
    }
  } else if (!is_at_end()) {
    board::eeprom_write(address, next_byte());
  } else {
    board::eeprom_write(start, SLOT_MARK);
    is_checking_ = true;
    offset_ = 0;
  }
}

void Settings::fail() {
  const uint8_t attempts = static_cast<uint8_t>(attempts_ + 1);
  begin_save();
  attempts_ = attempts;
  if (attempts < MAX_ATTEMPTS) return;
  kinds_[kind_].is_pending = false;
  kinds_[kind_].is_broken = !kinds_[kind_].is_stored;
}

void Settings::finish() {
  KindState& state = kinds_[kind_];
  state.is_pending = false;
  state.is_stored = true;
  state.slot ^= 1;
  ++state.sequence;
  state.is_broken = false;
  begin_save();
}

/** The byte that belongs at `offset_`; moves on, and keeps the CRC of the bytes before. */
uint8_t Settings::next_byte() {
  const uint8_t at = offset_++;
  if (at == 0) {
    crc_ = Crc16();
    return is_checking_ ? SLOT_MARK : SLOT_NO_MARK;
  }
  const uint8_t end = static_cast<uint8_t>(SLOT_HEADER_SIZE + size_of(kind_));
  if (at >= end) return at == end ? crc_.high() : crc_.low();
  uint8_t value;
  if (at == 1) {
    value = VERSION;
  } else if (at == 2) {
    value = static_cast<uint8_t>(kinds_[kind_].sequence + 1);
  } else {
    uint8_t data[LARGEST_SIZE];
    fill(data);
    value = data[at - SLOT_HEADER_SIZE];
  }
  crc_.put(value);
  return value;
}

/** The slot that is not the newest. */
uint16_t Settings::target() const { return slot_address(kind_, kinds_[kind_].slot ^ 1); }

bool Settings::is_at_end() const { return offset_ >= size_of(kind_) + SLOT_OVERHEAD; }

bool Settings::apply(Kind kind, const uint8_t* data) {
  if (kind == PROFILE) return read_profile(data, profile);
  if (kind == GAINS) return read_gains(data, gains);
  if (kind == CALIBRATION) return read_calibration(data, calibration);
  memcpy(&battery_full_scale_mv, data, BATTERY_SIZE);
  return true;
}

void Settings::fill(uint8_t* data) const {
  if (kind_ == PROFILE) {
    write_profile(profile, data);
  } else if (kind_ == GAINS) {
    write_gains(gains, data);
  } else if (kind_ == CALIBRATION) {
    write_calibration(calibration, data);
  } else {
    memcpy(data, &battery_full_scale_mv, BATTERY_SIZE);
  }
}

}  // namespace raspilot
