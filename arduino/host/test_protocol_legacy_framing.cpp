#include <doctest/doctest.h>

#include <random>

#include "flying_board.h"
#include "link_bench.h"
#include "protocol/legacy_framing_detector.h"
#include "wire_vectors.h"

using namespace raspilot;

namespace {

const std::string ALTITUDE("h\x01\x2c", 3);
const std::string HEADING("b\x01\x3b", 3);
const std::string REQUIRED(std::string("B\x00\x5b", 3));
const std::string LOCATION("l\x42\x48\x00\x00\x41\x68\x00\x00", 9);
const std::string PANIC("p\x01\x00\x96", 4);

std::string gains() {
  return "t" + std::string(4 * 12, '\0');
}

/** How many bytes the detector takes until it opens; 0 when it does not. */
size_t opened_after(const std::string& bytes) {
  LegacyFramingDetector detector = {};
  for (size_t at = 0; at < bytes.size(); ++at) {
    if (detector.receive(static_cast<uint8_t>(bytes[at]), 0)) return at + 1;
  }
  return 0;
}

bool opens(const std::string& bytes) { return opened_after(bytes) == bytes.size(); }

}  // namespace

TEST_CASE("an old Raspberry Pi opens the detector") {
  CHECK(opens(gains() + "T"));
  CHECK(opens(gains() + ALTITUDE));
  CHECK(opens(PANIC + PANIC));
  CHECK(opens(HEADING + LOCATION + REQUIRED));
  CHECK(opens(HEADING + ALTITUDE + LOCATION + "T" + HEADING));
  CHECK(opens(LOCATION + LOCATION + LOCATION + LOCATION));
}

TEST_CASE("less than that does not open it") {
  CHECK(opened_after(gains()) == 0);
  CHECK(opened_after(std::string(1000, 'T')) == 0);
  CHECK(opened_after(std::string(999, 'h')) == 0);
  CHECK(opened_after(ALTITUDE + LOCATION + HEADING) == 0);
  CHECK(opened_after(LOCATION + LOCATION + LOCATION) == 0);
}

TEST_CASE("no endlessly repeated byte opens it") {
  for (int byte = 0; byte < 256; ++byte) {
    CHECK(opened_after(std::string(2000, static_cast<char>(byte))) == 0);
  }
}

TEST_CASE("other bytes, values out of range and unfinished Commands break the run") {
  const std::string half = HEADING + REQUIRED;
  CHECK(opens(half + LOCATION));
  CHECK(opened_after(half + "\xff" + LOCATION) == 0);
  CHECK(opened_after(half + std::string(1, '\0') + LOCATION) == 0);
  CHECK(opened_after(half + "b\x01\x68" + LOCATION) == 0);
  CHECK(opened_after(half + "b\xff\xff" + LOCATION) == 0);
  CHECK(opened_after(half + "p\x02") == 0);
  CHECK(opened_after(half + std::string("p\x01\x00\x09", 4)) == 0);
  CHECK(opened_after(half + std::string("l\x7f\xc0\x00\x00\x00\x00\x00\x00", 9)) == 0);
  CHECK(opened_after(half + std::string("l\x00\x00\x00\x00\x7f\x80\x00\x00", 9)) == 0);
  for (const char* bad : {"7fc00000", "7f800000", "42480001", "bf800000"}) {
    std::string set = gains();
    const Bytes gain = bytes_of(bad);
    set.replace(1 + 4 * 7, 4, std::string(gain.begin(), gain.end()));
    CHECK(opened_after(half + set) == 0);
  }
  LegacyFramingDetector detector = {};
  for (char byte : half + "l") detector.receive(static_cast<uint8_t>(byte), 0);
  detector.expire(99999);
  bool is_open = false;
  for (char byte : LOCATION.substr(1)) is_open |= detector.receive(static_cast<uint8_t>(byte), 99999);
  CHECK(is_open);
  detector = LegacyFramingDetector();
  for (char byte : half + "l") detector.receive(static_cast<uint8_t>(byte), 0);
  detector.expire(102048);
  is_open = false;
  for (char byte : LOCATION) is_open |= detector.receive(static_cast<uint8_t>(byte), 102048);
  CHECK_FALSE(is_open);
}

TEST_CASE("ten million random bytes do not open it, whatever their pauses") {
  std::mt19937 random(20150517);
  LegacyFramingDetector detector = {};
  uint32_t now_us = 0;
  unsigned openings = 0;
  for (int count = 0; count < 10000000; ++count) {
    const uint32_t drawn = static_cast<uint32_t>(random());
    if ((drawn >> 8 & 0x3F) == 0) now_us += 150000;
    openings += detector.receive(static_cast<uint8_t>(drawn), now_us);
  }
  CHECK(openings == 0);
}

TEST_CASE("random bytes of the thesis's own letters do not open it") {
  std::mt19937 random(4711);
  const std::string letters = "ptThbBl";
  LegacyFramingDetector detector = {};
  unsigned openings = 0;
  for (int count = 0; count < 3000000; ++count) {
    openings += detector.receive(static_cast<uint8_t>(letters[random() % letters.size()]), 0);
  }
  CHECK(openings == 0);
}

TEST_CASE("through the detector thesis framing is spoken until reset") {
  LinkBench bench;
  bench.take_raw();
  bench.receive(gains() + "T");
  CHECK(bench.autopilot.link.is_thesis());
  // Neither was carried out, and no start was needed.
  CHECK(bench.take_raw().empty());
  bench.run_ms(60);
  const Bytes streamed = bench.take_raw();
  REQUIRE(streamed.size() % 9 == 0);
  CHECK(streamed[0] == 'r');
  bench.receive("T");
  bench.run_ms(10);
  const Bytes answer = bench.take_raw();
  REQUIRE(answer.size() >= 49);
  CHECK(answer[0] == 'T');
  bench.send('s');
  CHECK(bench.autopilot.link.is_thesis());
}

TEST_CASE("thesis framing takes no Command with authority, and answers as old firmware does") {
  LinkBench bench;
  bench.receive(gains() + "T");
  bench.take_raw();
  for (char type : {'a', 'M', 'u', 'S', 'C', 'e', 's', 'g'}) {
    bench.receive(std::string(1, type));
    const Bytes answer = bench.take_raw();
    CHECK(answer == Bytes{'!', static_cast<uint8_t>(type)});
  }
  CHECK_FALSE(bench.autopilot.authority.is_armed());
  bench.receive(std::string("p\x03\x00\x32", 4));
  CHECK(bench.take_raw() == Bytes{'!', 'p'});
  bench.receive("h\x01");
  bench.now_us += 102048;
  bench.autopilot.link.check(bench.now_us);
  CHECK(bench.take_raw() == Bytes{'!'});
}

TEST_CASE("a valid checked frame closes the detector; a broken one, or one of no type, does not") {
  LinkBench closed;
  closed.send('v', {0});
  closed.receive(gains() + "T" + PANIC + PANIC);
  CHECK_FALSE(closed.autopilot.link.is_thesis());
  LinkBench open;
  open.send('?');
  open.receive(Bytes{5, 1, 2, 3, 4, 0});
  open.receive(gains() + "T");
  CHECK(open.autopilot.link.is_thesis());
}

TEST_CASE("an armed aircraft keeps checked framing, whatever the line brings") {
  fake_board().reset();
  FlyingBoard board;
  board.wake();
  board.flick_aux2();
  REQUIRE(board.autopilot.authority.is_armed());
  for (char byte : gains() + "T" + PANIC + PANIC) {
    board.autopilot.link.on_byte(static_cast<uint8_t>(byte), board.now_us());
  }
  CHECK_FALSE(board.autopilot.link.is_thesis());
  board.sticks[AUX2] = 1000;
  board.run(400);
  REQUIRE_FALSE(board.autopilot.authority.is_armed());
  for (char byte : gains() + "T") {
    board.autopilot.link.on_byte(static_cast<uint8_t>(byte), board.now_us());
  }
  CHECK(board.autopilot.link.is_thesis());
}
