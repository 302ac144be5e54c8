/**
 * The serial conversation with the Raspberry Pi: framing, Command Receiver, Command Executor,
 * answers and streams (docs/protocols.md 2). Knows no chip.
 */
#pragma once

#include "../core/reference.h"
#include "../core/compiler.h"
#include "../core/types.h"
#include "answers.h"
#include "checked_reader.h"
#include "command_executor.h"
#include "forwarder.h"
#include "../core/board.h"
#include "frame.h"
#include "frame_writer.h"

namespace raspilot {

class Autopilot;

class Link {
 public:
  explicit Link(Autopilot& autopilot);

  /** Takes one byte from the line; at most ~10 us unless a frame ends with it. */
  void on_byte(uint8_t byte, uint32_t now_us);
  /** Drops a frame unfinished for 100 ms, without a further byte. At least every ten seconds. */
  void check(uint32_t now_us);
  /** Sends an answer that waited for room, or a stream message that is due; false for none. */
  bool background(uint32_t now_us);
  /** Sends the extra zero that opens the line. */
  void open();

  /** The frame that is being written: begin() is false when it does not fit, end() sends it. */
  typedef FrameWriter<board::serial_put> Frame;
  bool begin(char type, uint8_t size);
  void end() { board::serial_send(Frame::finish()); }
  /** Sends one whole frame, or nothing when it does not fit. */
  bool send(char type, const uint8_t* payload, uint8_t size);
  /** Whether a frame with this number of payload bytes fits now. */
  bool has_room(uint8_t size) const;

  /** The Start Command: forwarding begins. */
  void start(uint32_t now_us) { forwarder_.start(now_us); }
  /** Panic: the period of forwarded data, 10 to 1000 ms. */
  void set_period_ms(uint16_t period_ms) { forwarder_.set_period_ms(period_ms); }
  /** Age of the orientation frame with this sequence, us; very great when it is not known. */
  uint32_t orientation_age_us(uint16_t sequence, uint32_t now_us) const {
    return forwarder_.orientation_age_us(sequence, now_us);
  }

  bool is_started() const { return forwarder_.is_started(); }
  /** Whether the Raspberry Pi has sent a valid message within 1 s. */
  bool has_received(uint32_t now_us) const;
  /** Frames dropped, and frames missing by sequence, since reset; they stay at 65535. */
  uint16_t dropped() const { return dropped_; }
  uint16_t missing() const { return missing_; }

 private:
  void on_frame(uint32_t now_us);
  void expire(uint32_t now_us);
  void count_sequence(uint8_t sequence);
  void carry_out(const CommandDefinition& command, const Request& request);
  void refuse_seldom(char type, uint8_t sequence, Reason reason, uint32_t now_us);
  bool send_answer(uint32_t now_us);
  bool ask(PendingAnswer& pending, uint32_t now_us);
  void on_dropped();

  Reference<Autopilot> autopilot_;
  Answers answers_;
  RefusalLimit limit_;
  Forwarder forwarder_;
  uint16_t last_rx_units_ ZEROED;
  uint16_t dropped_ ZEROED;
  uint16_t missing_ ZEROED;
  uint8_t sequence_ ZEROED;
  uint8_t expected_ ZEROED;
  bool has_expected_ ZEROED;
  bool is_heard_ ZEROED;
  // Small members lie before it, where one instruction reaches them.
  CheckedReader reader_;
};

}  // namespace raspilot
