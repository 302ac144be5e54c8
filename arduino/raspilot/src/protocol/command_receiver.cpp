#include "command_receiver.h"

namespace raspilot {

CommandReceiver::Found CommandReceiver::receive(uint8_t byte, uint32_t now_us) {
  if (!is_in_payload_) {
    if (!CommandExecutor::find(static_cast<char>(byte), definition_) ||
        definition_.framing != Framing::BOTH) {
      return Found::UNKNOWN;
    }
    beginning_.note(now_us);
    length_ = 0;
    is_in_payload_ = definition_.size != 0;
    return is_in_payload_ ? Found::NOTHING : Found::COMMAND;
  }
  buffer_.bytes[length_++] = byte;
  if (length_ < definition_.size) return Found::NOTHING;
  is_in_payload_ = false;
  return Found::COMMAND;
}

bool CommandReceiver::expire(uint32_t now_us) {
  if (!is_in_payload_ || !beginning_.is_too_old(now_us)) return false;
  is_in_payload_ = false;
  return true;
}

}  // namespace raspilot
