/**
 * libFuzzer over the firmware on its serial line. The first byte of an input chooses when the clock
 * begins; then follow steps of one letter and its operands, see `step`.
 */
#include "fuzzed_board.h"

using namespace raspilot;

namespace {

/** Steps beyond this time only wait. */
constexpr uint32_t MAX_SLOTS = 3000;

class Input {
 public:
  Input(const uint8_t* data, size_t size) : at_(data), end_(data + size) {}

  bool is_empty() const { return at_ == end_; }
  uint8_t u8() { return is_empty() ? 0 : *at_++; }
  Bytes bytes(size_t most) {
    const size_t left = static_cast<size_t>(end_ - at_);
    const uint8_t* const first = at_;
    at_ += most < left ? most : left;
    return Bytes(first, at_);
  }

 private:
  const uint8_t* at_;
  const uint8_t* const end_;
};

/** The clock wraps immediately, after 2 s, or after an hour and more. */
uint32_t begin_us(uint8_t choice) {
  const uint32_t moments[] = {0, 0xFFFFFFFF - 2000000, 0x7FFFFFFF - 2000000, 0xFFFFFFFF};
  return moments[choice & 3];
}

void step(FuzzedBoard& board, Input& input, uint32_t& slots_left) {
  const auto run = [&](uint32_t slots) {
    const uint32_t run_now = slots < slots_left ? slots : slots_left;
    slots_left -= run_now;
    board.run(run_now);
  };
  switch (input.u8()) {
    case 'b':  // bare bytes
      for (uint8_t byte : input.bytes(input.u8())) board.receive(byte);
      break;
    case 'f': {  // a frame with any payload
      const uint8_t type = input.u8();
      board.receive_frame(type, input.bytes(input.u8() % 97));
      break;
    }
    case 'c': {  // a Command of the right size
      const uint8_t type = input.u8();
      const int size = size_to_arduino(type);
      Bytes payload = input.bytes(size > 0 ? static_cast<size_t>(size) : 0);
      payload.resize(size > 0 ? static_cast<size_t>(size) : 0);
      board.receive_frame(type, payload);
      break;
    }
    case 'w': run(input.u8()); break;
    case 'W': run(600); break;
    case 's': board.stall(input.u8() * 1000u); break;
    case 'x': {  // a stick moves
      const uint8_t channel = input.u8() % INPUTS;
      board.set_stick(channel, static_cast<uint16_t>(900 + input.u8() * 5));
      break;
    }
    case 'i': board.switch_imu(); break;
    case 'r': board.switch_receiver(); break;
    default: run(1); break;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Input input(data, size);
  FuzzedBoard board(begin_us(input.u8()));
  uint32_t slots_left = MAX_SLOTS;
  while (!input.is_empty()) step(board, input, slots_left);
  board.run(10);
  return 0;
}
