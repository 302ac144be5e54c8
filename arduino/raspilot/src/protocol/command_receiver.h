/** The Command Receiver of thesis framing: two states, type or payload (thesis 4.4.2). */
#pragma once

#include <stdint.h>

#include "../core/compiler.h"
#include "command_executor.h"
#include "frame.h"

namespace raspilot {

class CommandReceiver {
 public:
  enum class Found : uint8_t { NOTHING, COMMAND, UNKNOWN };

  explicit CommandReceiver(ReceiveBuffer& buffer) : buffer_(buffer) {}

  /** Takes one byte; a COMMAND stays readable until the next byte is taken. */
  Found receive(uint8_t byte, uint32_t now_us);
  /** Drops a Command that is unfinished 100 ms after its type; true when there was one. */
  bool expire(uint32_t now_us);

  const CommandDefinition& definition() const { return definition_; }
  const uint8_t* payload() const { return buffer_.bytes; }

 private:
  ReceiveBuffer& buffer_;
  CommandDefinition definition_ ZEROED;
  Beginning beginning_;
  uint8_t length_ ZEROED;
  bool is_in_payload_ ZEROED;
};

}  // namespace raspilot
