#include "command_executor.h"

#include "frame.h"

#include "../core/compiler.h"

namespace raspilot {

// Zero before any constructor runs, whatever their order.
CommandGroup* CommandGroup::first_ = nullptr;

OUT_OF_LINE void CommandGroup::enter(const CommandDefinition* table, uint8_t count) {
  table_ = table;
  count_ = count;
  next_ = first_;
  first_ = this;
}

bool CommandExecutor::find(char type, CommandDefinition& found) {
  for (const CommandGroup* group = CommandGroup::first_; group != nullptr; group = group->next_) {
    const CommandDefinition* at = group->table_;
    for (uint8_t left = group->count_; left != 0; --left, ++at) {
      if (static_cast<char>(pgm_read_byte(&at->type)) != type) continue;
      memcpy_P(&found, at, sizeof found);
      // A longer one would not fit into the receive buffer.
      return found.size <= MAX_COMMAND;
    }
  }
  return false;
}

uint8_t CommandExecutor::count(char type) {
  uint8_t count = 0;
  for (const CommandGroup* group = CommandGroup::first_; group != nullptr; group = group->next_) {
    for (uint8_t index = 0; index < group->count_; ++index) {
      count = static_cast<uint8_t>(
          count + (static_cast<char>(pgm_read_byte(&group->table_[index].type)) == type));
    }
  }
  return count;
}

}  // namespace raspilot
