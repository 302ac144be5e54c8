#include "saved_state.h"

#include "../core/compiler.h"
#include "../protocol/crc16.h"

namespace raspilot {

namespace {

/** Compiler barrier: orders stores in memory, as a reset may come at any instruction. */
inline void settle() { __asm__ volatile("" ::: "memory"); }

}  // namespace

OUT_OF_LINE uint16_t SavedStates::crc_of(const SavedState& state, uint8_t sequence) {
  const uint8_t* bytes = reinterpret_cast<const uint8_t*>(&state);
  Crc16 crc;
  crc.put(sequence);
  for (uint8_t at = 0; at < sizeof state; ++at) crc.put(bytes[at]);
  return static_cast<uint16_t>(crc.high() << 8 | crc.low());
}

bool SavedStates::is_whole(const Copy& copy) {
  return copy.crc == crc_of(copy.state, copy.sequence);
}

/** The copy that counts, by sequence: neither whole nor broken matters here. */
OUT_OF_LINE uint8_t SavedStates::newest() const {
  const uint8_t ahead = static_cast<uint8_t>(copies_[1].sequence - copies_[0].sequence);
  return static_cast<int8_t>(ahead) > 0;
}

OUT_OF_LINE void SavedStates::write(const SavedState& state) {
  const uint8_t newer = newest();
  Copy& copy = copies_[newer ^ 1];
  // A reset from here on finds the other copy, which is as old as one write. The sequence changes
  // last, so that a torn copy counts as the older and is the next to be written.
  copy.crc = static_cast<uint16_t>(~copy.crc);
  settle();
  copy.state = state;
  const uint8_t sequence = static_cast<uint8_t>(copies_[newer].sequence + 1);
  const uint16_t crc = crc_of(copy.state, sequence);
  settle();
  copy.crc = crc;
  copy.sequence = sequence;
  settle();
}

bool SavedStates::read(SavedState& state) const {
  uint8_t slot = newest();
  if (!is_whole(copies_[slot])) slot ^= 1;
  if (!is_whole(copies_[slot])) return false;
  state = copies_[slot].state;
  return true;
}

void SavedStates::reset() {
  for (Copy& copy : copies_) copy.crc = static_cast<uint16_t>(~crc_of(copy.state, copy.sequence));
}

}  // namespace raspilot
