/**
 * The register of Commands and their handlers (thesis 3.1.2, 4.4.2). A file in commands/ fills in a
 * table and a CommandGroup beside it; nothing else names it.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "../core/flash.h"
#include "../core/types.h"

namespace raspilot {

class Autopilot;

/** One Command as received, its size already right. */
struct Request {
  const uint8_t* payload;
  uint8_t sequence;
  uint32_t now_us;
};

/** Carries a Command out; Reason::NONE, or why it is refused (then it had no effect). */
typedef Reason (*Handler)(Autopilot& autopilot, const Request& request);

/**
 * How the Command is answered. CONFIRMED: `K`. UNANSWERED: a stream, refused at
 * most once a second. OWN: the handler sends the answer by Link::send; it has no payload, and it
 * is called when the line has room for the longest message.
 */
enum class Answer : uint8_t { CONFIRMED, UNANSWERED, OWN };

/** Description of a Command's type; tables of these lie in flash (PROGMEM). */
struct CommandDefinition {
  char type;
  uint8_t size;
  Answer answer;
  Handler handler;
};

/** A table of Commands that enters the register when the firmware starts. */
class CommandGroup {
 public:
  template <size_t N>
  explicit CommandGroup(const CommandDefinition (&table)[N]) {
    enter(table, static_cast<uint8_t>(N));
  }
  CommandGroup(const CommandGroup&) = delete;
  CommandGroup& operator=(const CommandGroup&) = delete;

 private:
  friend class CommandExecutor;

  void enter(const CommandDefinition* table, uint8_t count);

  static CommandGroup* first_;

  const CommandDefinition* table_;
  CommandGroup* next_;
  uint8_t count_;
};

class CommandExecutor {
 public:
  /** Looks a type up; false unless it is registered with at most MAX_COMMAND bytes. */
  static bool find(char type, CommandDefinition& found);
  /** How many Commands are registered for this type: one, unless two files name the same. */
  static uint8_t count(char type);
};

}  // namespace raspilot
