#include <doctest/doctest.h>

#include <algorithm>

#include "flying_board.h"
#include "wire_floats.h"

using namespace raspilot;

namespace {

typedef std::vector<uint8_t> Bytes;

constexpr size_t FLAGS_AT = 3;
constexpr size_t CAUSE_AT = 5;
constexpr uint8_t ARMED = 1;
constexpr uint8_t GAINS_STORED = 64;

Bytes gains_of(float gain) {
  Bytes wire(GAINS_SIZE);
  for (int count = 0; count < 18; ++count) put_f32(wire.data() + 4 * count, gain);
  return wire;
}

/** A board that was never switched on before, awake. */
struct NewBoard {
  NewBoard() { fake_board().reset(); }
};

struct Awake : NewBoard, FlyingBoard {
  Awake() { wake(); }
};

struct Armed : Awake {
  Armed() {
    flick_aux2();
    REQUIRE(autopilot.authority.is_armed());
  }
};

bool is_answered(FlyingBoard& board, char type) {
  for (const SentFrame& frame : board.frames) {
    if (frame.type == 'K' && frame.payload[0] == type) return true;
  }
  return false;
}

uint32_t greatest_gap_us(const FlyingBoard& board, char type) {
  uint32_t newest_us = 0;
  uint32_t gap_us = 0;
  for (const SentFrame& frame : board.frames) {
    if (frame.type != type) continue;
    if (newest_us != 0) gap_us = std::max(gap_us, frame.at_us - newest_us);
    newest_us = frame.at_us;
  }
  return gap_us;
}

}  // namespace

TEST_CASE("FBW flies until the Outputs come that the Raspberry Pi has asked to send") {
  Armed board;
  board.sticks[AUX1] = 2000;
  board.send('s');
  board.imu.turn(50, 0, 0);
  board.run(400);
  board.imu.turn(0, 0, 0);
  board.run(100);
  REQUIRE(board.output_us(AILERONS) < 1400);
  board.send('M', {'u'});
  for (int slot = 0; slot < 100; ++slot) {
    board.run(2);
    REQUIRE(board.autopilot.authority.mode() == Mode::OUTPUT);
    REQUIRE(board.output_us(AILERONS) < 1400);
    REQUIRE(board.output_us(ELEVATOR) > 1300);
  }
}

TEST_CASE("an armed aircraft that is still for once does not take that for its gyro's bias") {
  fake_board().reset();
  FlyingBoard board;
  board.autopilot.settings.calibration.gyro_bias_16[0] = 1;
  board.autopilot.attitude.begin();
  board.imu.gyro_noise_deg_s = 8;
  board.wake();
  REQUIRE(board.autopilot.attitude.is_bias_from_eeprom());
  board.flick_aux2();
  REQUIRE(board.autopilot.authority.is_armed());
  board.imu.gyro_noise_deg_s = 0.06;
  board.run(5000);
  CHECK(board.autopilot.attitude.is_still());
  CHECK(board.autopilot.attitude.is_bias_from_eeprom());
  board.sticks[AUX2] = 1000;
  board.run(3000);
  CHECK_FALSE(board.autopilot.authority.is_armed());
}

TEST_CASE("the Raspberry Pi starts the streams and reads the status") {
  Awake board;
  board.run(500);
  CHECK(board.take('O').type == 0);
  board.send('s');
  board.run(1000);
  CHECK(is_answered(board, 's'));
  int orientations = 0;
  int inputs = 0;
  int outputs = 0;
  for (const SentFrame& frame : board.frames) {
    orientations += frame.type == 'O';
    inputs += frame.type == 'i';
    outputs += frame.type == 'r';
  }
  CHECK(orientations >= 49);
  CHECK(inputs >= 49);
  CHECK(outputs >= 49);
  const SentFrame status = board.take('x');
  REQUIRE(status.payload.size() == STATUS_SIZE);
  CHECK(status.payload[0] == 1);
  CHECK((status.payload[FLAGS_AT] & ARMED) == 0);
  CHECK(status.payload[CAUSE_AT] == RESET_POWER_ON);
  CHECK(status.payload[6] * 256 + status.payload[7] == 2000);
  CHECK(fake_board().violations == 0);
}

TEST_CASE("gains of the Raspberry Pi are used immediately and saved, without delaying the streams") {
  Awake board;
  board.send('s');
  board.run(400);
  board.frames.clear();
  board.send('g', gains_of(7.5f));
  uint32_t slots = 0;
  for (; board.autopilot.settings.is_saving() && slots < 5000; ++slots) board.run(2);
  REQUIRE(slots < 5000);
  CHECK(is_answered(board, 'g'));
  size_t orientations = 0;
  for (const SentFrame& frame : board.frames) orientations += frame.type == 'O';
  CHECK(orientations >= slots / 10 - 1);
  CHECK(orientations >= 5);
  CHECK(greatest_gap_us(board, 'O') <= 24000);
  board.run(500);
  CHECK((board.take('x').payload[FLAGS_AT] & GAINS_STORED) != 0);
  CHECK(board.autopilot.settings.gains.stabilize[2].d == 7.5f);
  const FlyingBoard later;
  CHECK(later.autopilot.settings.gains.stabilize[2].d == 7.5f);
}

TEST_CASE("a profile is taken and kept while disarmed, refused while armed") {
  Awake board;
  Profile glider = DEFAULT_PROFILE;
  glider.servos[AILERONS].is_reversed = true;
  Bytes wire(PROFILE_SIZE);
  write_profile(glider, wire.data());
  board.send('C', wire);
  board.run(3000);
  CHECK(is_answered(board, 'C'));
  board.sticks[AILERONS] = 1700;
  board.run(200);
  CHECK(board.output_us(AILERONS) == 1300);
  board.flick_aux2();
  REQUIRE(board.autopilot.authority.is_armed());
  board.frames.clear();
  write_profile(DEFAULT_PROFILE, wire.data());
  board.send('C', wire);
  board.run(100);
  const SentFrame refusal = board.take('!');
  REQUIRE(refusal.payload.size() == 3);
  CHECK(refusal.payload[2] == static_cast<uint8_t>(Reason::ONLY_ON_GROUND));
  CHECK(board.output_us(AILERONS) == 1300);
  const FlyingBoard later;
  CHECK(later.autopilot.settings.profile.servos[AILERONS].is_reversed);
}

TEST_CASE("an aircraft whose receiver's end points are being learned does not arm") {
  Awake board;
  board.send('e', {1});
  board.run(100);
  REQUIRE(board.autopilot.receiver.is_learning());
  CHECK((board.autopilot.authority.vetoes() & VETO_CALIBRATING) != 0);
  board.flick_aux2();
  CHECK_FALSE(board.autopilot.authority.is_armed());
}
