#include "command_executor.h"

#include "frame.h"

namespace raspilot {

namespace {

// Where the linker has put the tables.
extern "C" const CommandDefinition __start_raspilot_commands[];
extern "C" const CommandDefinition __stop_raspilot_commands[];

}  // namespace

bool CommandExecutor::find(char type, CommandDefinition& found) {
  for (const CommandDefinition* at = __start_raspilot_commands; at != __stop_raspilot_commands;
       ++at) {
    if (static_cast<char>(pgm_read_byte(&at->type)) != type) continue;
    memcpy_P(&found, at, sizeof found);
    // A longer one would not fit into the receive buffer.
    return found.size <= MAX_COMMAND;
  }
  return false;
}

uint8_t CommandExecutor::count(char type) {
  uint8_t count = 0;
  for (const CommandDefinition* at = __start_raspilot_commands; at != __stop_raspilot_commands;
       ++at) {
    count = static_cast<uint8_t>(count + (static_cast<char>(pgm_read_byte(&at->type)) == type));
  }
  return count;
}

}  // namespace raspilot
