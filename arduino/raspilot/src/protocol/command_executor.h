/**
 * The register of Commands and their handlers (thesis 3.1.2, 4.4.2). A file in commands/ has a
 * REGISTERED table; nothing else names it.
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

/** Description of a Command's type. */
struct CommandDefinition {
  char type;
  uint8_t size;
  Answer answer;
  Handler handler;
};

/**
 * Enters a table of CommandDefinition into the register: the linker puts all of them one after the
 * other, into flash. Their own alignment leaves no gap between them.
 */
#define REGISTERED \
  __attribute__((section("raspilot_commands"), used, aligned(alignof(CommandDefinition))))

/** Looks a type up; false unless it is registered with at most MAX_COMMAND bytes. */
bool find_command(char type, CommandDefinition& found);

}  // namespace raspilot
