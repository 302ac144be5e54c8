#include "command_executor.h"

#include "frame.h"

namespace raspilot {

namespace {

// Where the linker has put the tables.
extern "C" const CommandDefinition __start_raspilot_commands[];
extern "C" const CommandDefinition __stop_raspilot_commands[];

}  // namespace

bool find_command(char type, CommandDefinition& found) {
  for (const CommandDefinition* at = __start_raspilot_commands; at != __stop_raspilot_commands;
       ++at) {
    if (static_cast<char>(pgm_read_byte(&at->type)) != type) continue;
    memcpy_P(&found, at, sizeof found);
    // A longer one would not fit into the receive buffer.
    return found.size <= MAX_COMMAND;
  }
  return false;
}

}  // namespace raspilot
