#include "thesis_door.h"

#include <string.h>

#include "../store/gains.h"
#include "frame.h"

namespace raspilot {

namespace {

constexpr uint8_t POINTS_NEEDED = 8;
constexpr uint8_t COMMANDS_NEEDED = 2;
constexpr uint8_t NOT_OF_THE_THESIS = 255;

uint8_t size_of(char type) {
  switch (type) {
    case 'T': return 0;
    case 'h': case 'b': case 'B': return 2;
    case 'p': return 3;
    case 'l': return 8;
    case 't': return TWO_AXIS_GAINS_SIZE;
    default: return NOT_OF_THE_THESIS;
  }
}

uint8_t points_of(char type) {
  switch (type) {
    case 't': return 8;
    case 'p': return 4;
    case 'b': case 'B': return 3;
    case 'l': return 2;
    default: return 0;
  }
}

bool is_within(uint32_t bits, float lowest, float highest) {
  float value;
  memcpy(&value, &bits, sizeof value);
  return value >= lowest && value <= highest;
}

}  // namespace

bool ThesisDoor::take(uint8_t byte, uint32_t now_us) {
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
  points_ = static_cast<uint8_t>(points_ + points_of(type_));
  type_ = 0;
  if (commands_ < COMMANDS_NEEDED) ++commands_;
  return commands_ >= COMMANDS_NEEDED && points_ >= POINTS_NEEDED;
}

void ThesisDoor::begin(char type, uint32_t now_us) {
  const uint8_t size = size_of(type);
  if (size == NOT_OF_THE_THESIS) {
    break_run();
    return;
  }
  type_ = type;
  left_ = size;
  first_us_ = now_us;
}

void ThesisDoor::expire(uint32_t now_us) {
  if (left_ != 0 && now_us - first_us_ >= UNFINISHED_US) break_run();
}

/** Looks at the field that ended with the newest byte; true in the middle of one. */
bool ThesisDoor::is_field_good() const {
  const int16_t number = static_cast<int16_t>(window_);
  switch (type_) {
    case 'b': case 'B': return left_ != 0 || (number >= 0 && number <= 359);
    case 'p':
      if (left_ == 2) return (window_ & 0xFF) <= 1;
      return left_ != 0 || (number >= 10 && number <= 1000);
    case 't': return (left_ & 3) != 0 || is_within(window_, 0.0f, GREATEST_GAIN);
    case 'l':
      if (left_ == 4) return is_within(window_, -90.0f, 90.0f);
      return left_ != 0 || is_within(window_, -180.0f, 180.0f);
    default: return true;
  }
}

void ThesisDoor::break_run() {
  type_ = 0;
  left_ = 0;
  points_ = 0;
  commands_ = 0;
}

}  // namespace raspilot
