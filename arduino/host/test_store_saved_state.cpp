#include <doctest/doctest.h>
#include <string.h>

#include <algorithm>
#include <vector>

#include "store/saved_state.h"

using namespace raspilot;

namespace {

typedef std::vector<uint8_t> Bytes;

SavedState numbered(int number) {
  SavedState state;
  memset(static_cast<void*>(&state), 0, sizeof state);
  state.authority.is_armed = true;
  state.authority.switch_position = 2;
  state.authority.requested_mode = 's';
  state.attitude.gravity_q30[0] = number;
  state.attitude.bias_q36[2] = -5;
  return state;
}

/** RAM after power-on. */
SavedStates noise(uint8_t seed) {
  SavedStates states;
  Bytes bytes(sizeof states);
  uint32_t random = seed;
  for (uint8_t& byte : bytes) {
    random = random * 1664525u + 1013904223u;
    byte = static_cast<uint8_t>(random >> 24);
  }
  memcpy(static_cast<void*>(&states), bytes.data(), sizeof states);
  return states;
}

int number_in(const SavedStates& states) {
  SavedState state = numbered(-2);
  return states.read(state) ? state.attitude.gravity_q30[0] : -1;
}

Bytes bytes_of(const SavedStates& states) {
  const uint8_t* first = reinterpret_cast<const uint8_t*>(&states);
  return Bytes(first, first + sizeof states);
}

}  // namespace

TEST_CASE("the state written last is read, from any RAM, round and round the sequence") {
  for (uint8_t seed = 0; seed < 200; ++seed) {
    SavedStates states = noise(seed);
    for (int number = 0; number < 300; ++number) {
      states.write(numbered(number));
      REQUIRE(number_in(states) == number);
    }
  }
}

TEST_CASE("a state is read back completely") {
  SavedStates states = noise(1);
  states.write(numbered(7));
  SavedState state = numbered(0);
  REQUIRE(states.read(state));
  CHECK(state.authority.is_armed);
  CHECK(state.authority.switch_position == 2);
  CHECK(state.authority.requested_mode == 's');
  CHECK(state.attitude.bias_q36[2] == -5);
}

TEST_CASE("RAM after power-on, all zeros and all ones hold no state") {
  for (uint8_t seed = 0; seed < 250; ++seed) CHECK(number_in(noise(seed)) == -1);
  for (int fill : {0x00, 0xFF}) {
    SavedStates states;
    memset(static_cast<void*>(&states), fill, sizeof states);
    CHECK(number_in(states) == -1);
  }
}

TEST_CASE("a reset in the midst of a write leaves the state of the write before") {
  SavedStates states = noise(3);
  for (int number = 0; number < 20; ++number) states.write(numbered(number));
  const Bytes before = bytes_of(states);
  states.write(numbered(20));
  const Bytes after = bytes_of(states);
  // A write changes one half alone; whatever its content, the other half is read.
  const size_t half = sizeof states / 2;
  const bool is_first = !std::equal(before.begin(), before.begin() + static_cast<long>(half), after.begin());
  REQUIRE(is_first == std::equal(before.begin() + static_cast<long>(half), before.end(),
                                 after.begin() + static_cast<long>(half)));
  for (size_t cut = is_first ? 0 : half; cut < (is_first ? half : 2 * half); ++cut) {
    Bytes torn = after;
    torn[cut] ^= 0x10;
    SavedStates left;
    memcpy(static_cast<void*>(&left), torn.data(), sizeof left);
    const int number = number_in(left);
    // Bytes between the fields belong to nothing on a PC; the chip has none.
    const bool is_read = number == 19 || number == 20;
    CHECK(is_read);
    left.write(numbered(21));
    CHECK(number_in(left) == 21);
  }
}

TEST_CASE("no single flipped bit yields a state that was never written") {
  SavedStates states = noise(4);
  states.write(numbered(1));
  states.write(numbered(2));
  const Bytes whole = bytes_of(states);
  for (size_t bit = 0; bit < whole.size() * 8; ++bit) {
    Bytes flipped = whole;
    flipped[bit / 8] = static_cast<uint8_t>(flipped[bit / 8] ^ 1 << bit % 8);
    SavedStates left;
    memcpy(static_cast<void*>(&left), flipped.data(), sizeof left);
    const int number = number_in(left);
    const bool is_read = number == 1 || number == 2;
    CHECK(is_read);
  }
}

TEST_CASE("a reset leaves nothing to read") {
  SavedStates states = noise(5);
  states.write(numbered(1));
  states.write(numbered(2));
  states.reset();
  CHECK(number_in(states) == -1);
  states.write(numbered(3));
  CHECK(number_in(states) == 3);
}
