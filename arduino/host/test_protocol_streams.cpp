#include <doctest/doctest.h>

#include <algorithm>

#include "flying_board.h"
#include "link_bench.h"
#include "store/wire_bytes.h"
#include "wire_floats.h"

using namespace raspilot;

namespace {

long count_of(const std::string& types, char type) {
  return std::count(types.begin(), types.end(), type);
}

struct Awake : FlyingBoard {
  Awake() {
    fake_board().reset();
    wake();
    send('s');
    run(100);
    frames.clear();
  }
  long streamed(char type, uint32_t ms) {
    frames.clear();
    run(ms);
    return std::count_if(frames.begin(), frames.end(),
                         [type](const SentFrame& frame) { return frame.type == type; });
  }
};

Bytes panic(uint16_t delay_ms) {
  Bytes payload(3);
  WireWriter writer(payload.data());
  writer.u8(1);
  writer.u16(delay_ms);
  return payload;
}

}  // namespace

TEST_CASE("inputs, orientation and outputs come every 20 ms, the status every 200") {
  Awake board;
  board.frames.clear();
  board.run(2000);
  for (char type : {'i', 'O', 'r'}) {
    const long count = std::count_if(board.frames.begin(), board.frames.end(),
                                     [type](const SentFrame& each) { return each.type == type; });
    CHECK(count >= 99);
    CHECK(count <= 101);
  }
  const long statuses = std::count_if(board.frames.begin(), board.frames.end(),
                                      [](const SentFrame& each) { return each.type == 'x'; });
  CHECK(statuses == 10);
}

TEST_CASE("the orientation counts its frames and tells degrees in its order") {
  Awake board;
  board.run(100);
  const SentFrame first = board.take('O');
  board.run(20);
  const SentFrame second = board.take('O');
  REQUIRE(first.payload.size() == 26);
  WireReader before(first.payload.data());
  WireReader after(second.payload.data());
  CHECK(after.u16() == static_cast<uint16_t>(before.u16() + 1));
  const Attitude& attitude = board.autopilot.attitude.attitude();
  const int16_t cdegs[3] = {attitude.yaw_cdeg, attitude.pitch_cdeg, attitude.roll_cdeg};
  for (size_t angle = 0; angle < 3; ++angle) {
    CHECK(f32_at(second.payload.data() + 2 + 4 * angle) ==
          doctest::Approx(cdegs[angle] / 100.0).epsilon(0.01).scale(10));
  }
}

TEST_CASE("no orientation is sent while the IMU is invalid") {
  Awake board;
  board.is_imu_on = false;
  board.run(100);
  CHECK(board.streamed('O', 500) == 0);
  board.is_imu_on = true;
  board.run_until([&board] { return board.autopilot.attitude.is_valid(); }, 3000);
  CHECK(board.streamed('O', 500) >= 24);
}

TEST_CASE("inputs are sent with their validity; a lost receiver's keep their last values") {
  Awake board;
  board.sticks[RUDDER] = 1234;
  board.run(300);
  SentFrame inputs = board.take('i');
  REQUIRE(inputs.payload.size() == 13);
  CHECK(inputs.payload[12] == ALL_INPUTS);
  CHECK(std::abs(WireReader(inputs.payload.data() + 6).u16() - 1234) <= 1);
  board.is_receiver_on = false;
  board.run(200);
  inputs = board.take('i');
  CHECK(inputs.payload[12] == 0);
}

TEST_CASE("panic stretches the forwarded streams immediately and reversibly, never the status") {
  Awake board;
  board.send('p', panic(150));
  CHECK(board.streamed('i', 1500) <= 11);
  CHECK(board.streamed('x', 1000) == 5);
  board.send('p', panic(1000));
  board.run(50);
  board.send('p', panic(20));
  CHECK(board.streamed('r', 1000) >= 49);
}

TEST_CASE("panic does not slow what the Raspberry Pi's flight controller consumes") {
  Mode mode = Mode::OUTPUT;
  SUBCASE("for Outputs") {}
  SUBCASE("for set-points") { mode = Mode::SETPOINT; }
  Awake board;
  board.sticks[AUX1] = 2000;
  board.flick_aux2();
  board.run(100);
  REQUIRE(board.autopilot.authority.is_armed());
  board.send('p', panic(150));
  for (int count = 0; count < 25; ++count) {
    board.run(20);
    const SentFrame orientation = board.take('O');
    // Outputs that follow keep the mode, as those of a flight controller do.
    if (count == 0) board.send('M', {static_cast<uint8_t>(mode)});
    if (orientation.type != 'O') continue;
    if (mode == Mode::SETPOINT) {
      board.send('S', {0, 0, 0, 0, 0, 0, 0, 0, 0, 250});
      continue;
    }
    Bytes output = {0x05, 0xDC, 0x05, 0xDC, 0, 0, 0x05, 0xDC};
    output.push_back(orientation.payload[0]);
    output.push_back(orientation.payload[1]);
    board.send('u', output);
  }
  REQUIRE(board.autopilot.authority.mode() == mode);
  board.frames.clear();
  board.run(200);
  const auto count = [&board](char type) {
    return std::count_if(board.frames.begin(), board.frames.end(),
                         [type](const SentFrame& each) { return each.type == type; });
  };
  CHECK(count('O') >= 9);
  CHECK(count('i') >= 9);
  CHECK(count('r') <= 2);
}

TEST_CASE("the age of an orientation is known by its sequence for 100 ms") {
  Awake board;
  board.run_until([&board] { return board.take('O').type == 'O'; }, 100);
  board.run(60);
  const SentFrame frame = board.take('O');
  REQUIRE(frame.type == 'O');
  const uint16_t sequence = WireReader(frame.payload.data()).u16();
  const Link& link = board.autopilot.link;
  CHECK(link.orientation_age_us(sequence, board.now_us()) < 25000);
  const uint32_t before = link.orientation_age_us(static_cast<uint16_t>(sequence - 2),
                                                  board.now_us());
  CHECK(before > 35000);
  CHECK(before < 65000);
  CHECK(link.orientation_age_us(static_cast<uint16_t>(sequence + 1), board.now_us()) >
        100000);
  CHECK(link.orientation_age_us(static_cast<uint16_t>(sequence - 20), board.now_us()) >
        100000);
  board.is_imu_on = false;
  board.run(400);
  CHECK(link.orientation_age_us(sequence, board.now_us()) > 100000);
  // The short stamps wrap after 4.2 s: they must be forgotten by then.
  for (uint32_t ms = 400; ms < 4600; ms += 2) {
    board.run(2);
    CHECK(link.orientation_age_us(sequence, board.now_us()) > 100000);
  }
}

TEST_CASE("a full line delays a stream, never queues it: the newest is sent") {
  LinkBench bench;
  bench.send('s');
  bench.run_ms(100);
  bench.take();
  bench.clog();
  for (int step = 0; step < 1000; ++step) {
    bench.now_us += 500;
    bench.clog();
    bench.autopilot.link.check(bench.now_us);
    bench.autopilot.link.background(bench.now_us);
  }
  CHECK(bench.take_raw().empty());
  bench.drain();
  bench.run_ms(15);
  const std::string types = bench.take_types();
  CHECK(count_of(types, 'i') == 1);
  CHECK(count_of(types, 'r') == 1);
  CHECK(count_of(types, 'x') == 1);
  CHECK(bench.is_clean);
  CHECK(fake_board().violations == 0);
}

TEST_CASE("streams keep their periods across the clock's wrap") {
  LinkBench bench(0xFFFFFFFF - 200000);
  bench.send('s');
  bench.run_ms(10);
  bench.take();
  bench.run_ms(400);
  const std::string types = bench.take_types();
  CHECK(count_of(types, 'i') >= 19);
  CHECK(count_of(types, 'i') <= 21);
  CHECK(count_of(types, 'x') == 2);
}
