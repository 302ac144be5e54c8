#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "flying_board.h"
#include "store/wire_bytes.h"

using namespace raspilot;

namespace {

typedef std::vector<uint8_t> Bytes;

constexpr size_t FLAGS_AT = 3;
constexpr size_t VETOES_AT = 4;
constexpr size_t CAUSE_AT = 5;
constexpr uint8_t ARMED = 1;
constexpr uint8_t GAINS_STORED = 64;

Bytes gains_of(float gain) {
  Bytes wire(GAINS_SIZE);
  WireWriter writer(wire.data());
  for (int count = 0; count < 18; ++count) writer.f32(gain);
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

TEST_CASE("the motor stands still from power-on until the aircraft is armed") {
  fake_board().reset();
  FlyingBoard board;
  board.sticks[THROTTLE] = 1900;
  for (int slot = 0; slot < 5000; ++slot) {
    board.run(2);
    REQUIRE(board.output_us(THROTTLE) == 1000);
  }
  CHECK(board.output_us(AILERONS) >= 1490);
  CHECK(board.output_us(AILERONS) <= 1510);
}

TEST_CASE("sticks pass through in ACRO, and the throttle once armed") {
  Armed board;
  board.sticks[AILERONS] = 1700;
  board.sticks[ELEVATOR] = 1300;
  board.sticks[THROTTLE] = 1600;
  board.sticks[RUDDER] = 1444;
  board.run(200);
  CHECK(board.autopilot.authority.mode() == Mode::ACRO);
  CHECK(board.output_us(AILERONS) == 1700);
  CHECK(board.output_us(ELEVATOR) == 1300);
  CHECK(board.output_us(THROTTLE) == 1600);
  CHECK(board.output_us(RUDDER) == 1444);
  board.sticks[AUX2] = 1000;
  board.sticks[THROTTLE] = 1000;
  REQUIRE(board.run_until([&] { return !board.autopilot.authority.is_armed(); }, 1000));
  CHECK(board.output_us(THROTTLE) == 1000);
}

TEST_CASE("FBW levels the aircraft") {
  Armed board;
  board.sticks[AUX1] = 1500;
  board.run(200);
  CHECK(board.autopilot.authority.mode() == Mode::FBW);
  board.imu.turn(50, 0, 0);
  board.run(400);
  board.imu.turn(0, 0, 0);
  board.run(100);
  REQUIRE(board.autopilot.attitude.attitude().roll_cdeg > 1500);
  CHECK(board.output_us(AILERONS) < 1400);
}

TEST_CASE("a lost receiver circles with the motor at its failsafe and stays armed") {
  Armed board;
  board.sticks[THROTTLE] = 1700;
  board.run(200);
  REQUIRE(board.output_us(THROTTLE) == 1700);
  board.is_receiver_on = false;
  CHECK(board.run_until([&] { return board.autopilot.authority.is_failsafe(); }, 1000));
  board.run(10);
  CHECK(board.output_us(THROTTLE) == 1000);
  CHECK(board.output_us(AILERONS) > 1550);
  CHECK(board.autopilot.authority.is_armed());
  board.sticks[THROTTLE] = 1650;
  board.is_receiver_on = true;
  CHECK(board.run_until([&] { return board.output_us(THROTTLE) == 1650; }, 500));
}

TEST_CASE("a lost IMU hands the surfaces to the sticks within 100 ms") {
  Armed board;
  board.sticks[AUX1] = 1500;
  board.sticks[AILERONS] = 1700;
  board.run(400);
  REQUIRE(board.autopilot.authority.mode() == Mode::FBW);
  REQUIRE(board.output_us(AILERONS) != 1700);
  board.is_imu_on = false;
  CHECK(board.run_until([&] { return board.output_us(AILERONS) == 1700; }, 100));
  CHECK(board.autopilot.authority.mode() == Mode::ACRO);
  CHECK(board.autopilot.authority.is_armed());
}

TEST_CASE("a reset in flight comes back armed, in its mode, with its attitude") {
  Armed board;
  board.sticks[AUX1] = 1500;
  board.imu.turn(100, 0, 0);
  board.run(200);
  board.imu.turn(0, 0, 0);
  board.sticks[THROTTLE] = 1600;
  board.run(500);
  SavedStates kept;
  kept.write(board.autopilot.state());
  SavedState state;
  REQUIRE(kept.read(state));
  const int16_t roll_cdeg = board.autopilot.attitude.attitude().roll_cdeg;
  REQUIRE(roll_cdeg > 1000);

  FlyingBoard later(&state, RESET_WATCHDOG);
  later.imu = board.imu;
  CHECK(later.autopilot.reset_cause == (RESET_WATCHDOG | RESET_RESTORED));
  CHECK(later.autopilot.authority.is_armed());
  for (uint8_t channel = 0; channel < INPUTS; ++channel) later.sticks[channel] = board.sticks[channel];
  later.run(200);
  CHECK(later.autopilot.authority.is_armed());
  CHECK(later.autopilot.authority.mode() == Mode::FBW);
  CHECK(later.output_us(THROTTLE) == 1600);
  const int difference_cdeg = later.autopilot.attitude.attitude().roll_cdeg - roll_cdeg;
  CHECK(difference_cdeg > -100);
  CHECK(difference_cdeg < 100);
  CHECK_FALSE(later.autopilot.attitude.is_calibrating());
}

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

TEST_CASE("power-on never arms, whatever the sticks") {
  fake_board().reset();
  FlyingBoard board;
  board.sticks[AUX2] = 2000;
  board.sticks[AUX1] = 2000;
  board.run(15000);
  CHECK_FALSE(board.autopilot.authority.is_armed());
  CHECK(board.autopilot.reset_cause == RESET_POWER_ON);
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
  REQUIRE(status.payload.size() == 20);
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

TEST_CASE("gains sent in flight live in RAM and never reach EEPROM") {
  Armed board;
  const uint32_t written = fake_board().writes;
  board.send('g', gains_of(4.25f));
  board.run(3000);
  CHECK(board.autopilot.authority.is_armed());
  CHECK(board.autopilot.settings.gains.rate[0].p == 4.25f);
  CHECK(fake_board().writes == written);
  board.sticks[AUX2] = 1000;
  board.run(3000);
  REQUIRE_FALSE(board.autopilot.authority.is_armed());
  CHECK(board.autopilot.settings.gains.rate[0].p == 4.25f);
  CHECK(fake_board().writes == written);
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

TEST_CASE("a profile that EEPROM has lost vetoes arming until there is a new one") {
  {
    Awake board;
    board.autopilot.settings.save_profile();
    board.run(3000);
  }
  for (uint8_t& cell : fake_board().eeprom) cell = cell == 0xA5 ? 0x5A : cell;
  FlyingBoard board;
  board.wake();
  CHECK((board.autopilot.authority.vetoes() & VETO_PROFILE_INVALID) != 0);
  board.flick_aux2();
  CHECK_FALSE(board.autopilot.authority.is_armed());
  Bytes wire(PROFILE_SIZE);
  write_profile(DEFAULT_PROFILE, wire.data());
  board.send('C', wire);
  board.run(3000);
  CHECK((board.autopilot.authority.vetoes() & VETO_PROFILE_INVALID) == 0);
  board.flick_aux2();
  CHECK(board.autopilot.authority.is_armed());
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

TEST_CASE("noise on the serial line neither arms nor disturbs") {
  Awake board;
  std::mt19937 random(11);
  for (int round = 0; round < 2000; ++round) {
    for (int count = 0; count < 20; ++count) {
      board.autopilot.link.on_byte(static_cast<uint8_t>(random()), board.now_us());
    }
    board.run(2);
    REQUIRE_FALSE(board.autopilot.authority.is_armed());
    REQUIRE(board.output_us(THROTTLE) == 1000);
  }
  CHECK(fake_board().violations == 0);
  CHECK(board.autopilot.settings.gains.rate[0].p == DEFAULT_GAINS.rate[0].p);
}
