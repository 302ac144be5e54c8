#include "link.h"

#include "../core/autopilot.h"
#include "../core/board.h"
#include "frame.h"

namespace raspilot {

namespace {

constexpr uint16_t HEARD_UNITS = units_at_least(1000);
constexpr uint16_t MAX = 65535;
constexpr uint8_t REFUSED_SIZE = 3;

}  // namespace

Link::Link(Autopilot& autopilot) : autopilot_(autopilot), forwarder_(autopilot) {}

void Link::open() {
  if (board::serial_room() == 0) return;
  board::serial_put(0, 0);
  board::serial_send(1);
}

void Link::on_byte(uint8_t byte, uint32_t now_us) {
  expire(now_us);
  switch (reader_.receive(byte, now_us)) {
    case CheckedReader::Found::FRAME: on_frame(now_us); break;
    case CheckedReader::Found::BROKEN: on_dropped(); break;
    case CheckedReader::Found::NOTHING: break;
  }
}

void Link::check(uint32_t now_us) {
  expire(now_us);
  limit_.check(now_us);
  forwarder_.check(now_us);
  is_heard_ = has_received(now_us);
}

bool Link::background(uint32_t now_us) {
  if (!answers_.is_empty()) return send_answer(now_us);
  return forwarder_.send_next(now_us);
}

OUT_OF_LINE bool Link::has_received(uint32_t now_us) const {
  return is_heard_ && static_cast<uint16_t>(to_units(now_us) - last_rx_units_) <= HEARD_UNITS;
}

bool Link::has_room(uint8_t size) const {
  return board::serial_room() >= size + FRAME_OVERHEAD + COBS_OVERHEAD;
}

bool Link::begin(char type, uint8_t size) {
  if (size > MAX_COMMAND || !has_room(size)) return false;
  Frame::begin(sequence_++, type);
  return true;
}

bool Link::send(char type, const uint8_t* payload, uint8_t size) {
  if (!begin(type, size)) return false;
  for (; size != 0; --size) Frame::u8(*payload++);
  end();
  return true;
}

void Link::on_frame(uint32_t now_us) {
  const char type = reader_.type();
  const uint8_t sequence = reader_.sequence();
  count_sequence(sequence);
  CommandDefinition command;
  const bool is_known = find_command(type, command);
  if (!is_known || command.size != reader_.payload_size()) {
    on_dropped();
    refuse_seldom(type, sequence, is_known ? Reason::WRONG_SIZE : Reason::UNKNOWN_TYPE, now_us);
    return;
  }
  const Request request = {reader_.payload(), sequence, now_us};
  carry_out(command, request);
}

/** A frame with a valid check did arrive, whatever else is wrong with it. */
void Link::count_sequence(uint8_t sequence) {
  if (has_expected_) {
    const uint8_t missed = static_cast<uint8_t>(sequence - expected_);
    missing_ = missing_ > MAX - missed ? MAX : static_cast<uint16_t>(missing_ + missed);
  }
  has_expected_ = true;
  expected_ = static_cast<uint8_t>(sequence + 1);
}

void Link::carry_out(const CommandDefinition& command, const Request& request) {
  is_heard_ = true;
  last_rx_units_ = to_units(request.now_us);
  const bool is_stream = command.answer == Answer::UNANSWERED;
  if (!is_stream && !answers_.has_place()) {
    // To execute it without an answer would be worse: the sender would repeat it.
    on_dropped();
    return;
  }
  if (command.answer == Answer::OWN) {
    answers_.push(PendingAnswer::ASK, command.type, request.sequence);
  } else {
    const Reason reason = command.handler(*autopilot_, request);
    if (reason == Reason::NONE) {
      if (!is_stream) answers_.push(PendingAnswer::CONFIRM, command.type, request.sequence);
    } else if (is_stream) {
      refuse_seldom(command.type, request.sequence, reason, request.now_us);
    } else {
      answers_.push(static_cast<uint8_t>(reason), command.type, request.sequence);
    }
  }
  // A handler that answers itself takes longer than a byte of the line may: background() calls it.
  if (!answers_.is_empty() && answers_.front().what != PendingAnswer::ASK) {
    send_answer(request.now_us);
  }
}

void Link::refuse_seldom(char type, uint8_t sequence, Reason reason, uint32_t now_us) {
  if (!answers_.has_place() || !limit_.allows(type, now_us)) return;
  answers_.push(static_cast<uint8_t>(reason), type, sequence);
  send_answer(now_us);
}

/** Sends the answer that waited longest; false when it does not fit yet. */
bool Link::send_answer(uint32_t now_us) {
  PendingAnswer& pending = answers_.front();
  if (pending.what == PendingAnswer::ASK && !ask(pending, now_us)) return false;
  if (pending.what != PendingAnswer::ASK) {
    const uint8_t payload[REFUSED_SIZE] = {pending.type, pending.sequence, pending.what};
    const bool is_sent = pending.what == PendingAnswer::CONFIRM
                             ? send('K', payload, REFUSED_SIZE - 1)
                             : send('!', payload, REFUSED_SIZE);
    if (!is_sent) return false;
  }
  answers_.pop();
  return true;
}

/** Lets a handler send its own answer; false without room. A refusal replaces the request. */
bool Link::ask(PendingAnswer& pending, uint32_t now_us) {
  CommandDefinition command;
  if (!has_room(MAX_COMMAND)) return false;
  if (!find_command(static_cast<char>(pending.type), command)) return true;
  const Request request = {reader_.payload(), pending.sequence, now_us};
  const Reason reason = command.handler(*autopilot_, request);
  if (reason != Reason::NONE) pending.what = static_cast<uint8_t>(reason);
  return true;
}

void Link::expire(uint32_t now_us) {
  if (reader_.expire(now_us)) on_dropped();
}

void Link::on_dropped() {
  if (dropped_ != MAX) ++dropped_;
}

}  // namespace raspilot
