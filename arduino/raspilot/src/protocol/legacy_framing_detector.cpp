#include "legacy_framing_detector.h"

#include "../core/flash.h"
#include "../store/gains.h"
#include "../store/wire_bytes.h"
#include "frame.h"

namespace raspilot {

namespace {

constexpr uint8_t POINTS_NEEDED = 8;
constexpr uint8_t COMMANDS_NEEDED = 2;
// 90.0f and 180.0f.
constexpr uint32_t MAX_LATITUDE = 0x42B40000;
constexpr uint32_t MAX_LONGITUDE = 0x43340000;

/** A Command of the thesis: its type, its size, its points. */
struct ThesisCommand {
  char type;
  uint8_t size;
  uint8_t points;
};

const ThesisCommand THESIS_COMMANDS[] PROGMEM = {
    {'T', 0, 0}, {'h', 2, 0}, {'b', 2, 3}, {'B', 2, 3},
    {'p', 3, 4}, {'l', 8, 2}, {'t', TWO_AXIS_GAINS_SIZE, 8},
};

}  // namespace

bool LegacyFramingDetector::receive(uint8_t byte, uint32_t now_us) {
  expire(now_us);
  if (left_ == 0) {
    begin(static_cast<char>(byte), now_us);
  } else {
    window_ = window_ << 8 | byte;
    --left_;
    if (!is_field_good()) {
      break_run();
      return false;
    }
  }
  if (type_ == 0 || left_ != 0) return false;
  points_ = static_cast<uint8_t>(points_ + worth_);
  type_ = 0;
  if (commands_ < COMMANDS_NEEDED) ++commands_;
  return commands_ >= COMMANDS_NEEDED && points_ >= POINTS_NEEDED;
}

void LegacyFramingDetector::begin(char type, uint32_t now_us) {
  for (const ThesisCommand& command : THESIS_COMMANDS) {
    if (static_cast<char>(pgm_read_byte(&command.type)) != type) continue;
    type_ = type;
    left_ = pgm_read_byte(&command.size);
    worth_ = pgm_read_byte(&command.points);
    beginning_.note(now_us);
    return;
  }
  break_run();
}

void LegacyFramingDetector::expire(uint32_t now_us) {
  if (left_ != 0 && beginning_.is_too_old(now_us)) break_run();
}

/** Checks the field that ended with the newest byte; true in the middle of one. */
bool LegacyFramingDetector::is_field_good() const {
  const int16_t number = static_cast<int16_t>(window_);
  switch (type_) {
    case 'b': case 'B': return left_ != 0 || (number >= 0 && number <= 359);
    case 'p':
      if (left_ == 2) return (window_ & 0xFF) <= 1;
      return left_ != 0 || (number >= 10 && number <= 1000);
    case 't': return (left_ & 3) != 0 || is_gain(window_);
    case 'l':
      if (left_ == 4) return is_magnitude_within(window_, MAX_LATITUDE);
      return left_ != 0 || is_magnitude_within(window_, MAX_LONGITUDE);
    default: return true;
  }
}

void LegacyFramingDetector::break_run() {
  type_ = 0;
  left_ = 0;
  points_ = 0;
  commands_ = 0;
}

}  // namespace raspilot
