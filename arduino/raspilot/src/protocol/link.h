/**
 * The serial conversation with the Raspberry Pi: framing, Command Receiver, Command Executor,
 * answers and streams (docs/protocols.md 2). Knows no chip.
 */
#pragma once

#include "../core/types.h"

namespace raspilot {

class Autopilot;

class Link {
 public:
  explicit Link(Autopilot& autopilot);

  /** Takes one byte from the line; at most ~10 us unless a frame ends with it. */
  void on_byte(uint8_t byte, uint32_t now_us);
  /** Drops what is unfinished for 100 ms; no further byte is needed. */
  void check(uint32_t now_us);
  /** Sends at most one stream message that is due and fits; false when none is due. */
  bool background(uint32_t now_us);
  /** Sends the extra zero that opens checked framing. */
  void open();

  /** Sends one whole message in the framing that is spoken, or nothing when it does not fit. */
  bool send(char type, const uint8_t* payload, uint8_t size);

  bool is_thesis() const;
  bool is_started() const;
  /** Whether the Raspberry Pi was heard within 1 s. */
  bool has_heard(uint32_t now_us) const;
};

}  // namespace raspilot
