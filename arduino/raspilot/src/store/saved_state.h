/** State that survives a reset in RAM that start-up does not clear. */
#pragma once

#include <stdint.h>

#include "../control/attitude_filter.h"
#include "../pilot/authority.h"

namespace raspilot {

struct SavedState {
  AuthorityState authority;
  AttitudeState attitude;
};

/** Two copies with sequence and CRC, written in turn; place it in `.noinit`. */
class SavedStates {
 public:
  void write(const SavedState& state);
  /** The newest copy whose CRC is right; false without one. */
  bool read(SavedState& state) const;
  /** Makes both copies unreadable. */
  void reset();

 private:
  struct Copy {
    SavedState state;
    uint8_t sequence;
    uint16_t crc;
  };

  static uint16_t crc_of(const SavedState& state, uint8_t sequence);
  static bool is_whole(const Copy& copy);
  uint8_t newest() const;

  Copy copies_[2];
};

}  // namespace raspilot
