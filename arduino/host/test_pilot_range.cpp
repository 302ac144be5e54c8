#include <doctest/doctest.h>

#include "pilot_bench.h"

using namespace raspilot;

namespace {

const ChannelRange NARROW = {1100, 1520, 1920};

/** Begins learning, moves every stick and switch through its range, then rests. */
void move_all(PilotBench& bench, const ChannelRange& range, uint16_t aux2_highest_us) {
  for (uint16_t& stick : bench.sticks) stick = range.lowest_us;
  bench.run(100);
  bench.reader.begin_range_learning();
  for (uint16_t us = range.lowest_us; us <= range.highest_us; us = static_cast<uint16_t>(us + 20)) {
    for (uint8_t i = 0; i < INPUTS; ++i) bench.sticks[i] = us;
    if (us > aux2_highest_us) bench.sticks[AUX2] = aux2_highest_us;
    bench.run(20);
  }
  for (uint8_t i = 0; i < INPUTS; ++i) bench.sticks[i] = range.centre_us;
  bench.sticks[THROTTLE] = bench.sticks[AUX1] = bench.sticks[AUX2] = range.lowest_us;
  bench.run(200);
}

}  // namespace

TEST_CASE("pilot range: the default changes nothing") {
  for (int pulse = us_to_ticks(885); pulse <= us_to_ticks(2115); ++pulse) {
    CHECK(calibrated(DEFAULT_CALIBRATION.receiver[0], static_cast<Ticks>(pulse)) == pulse);
  }
}

TEST_CASE("pilot range: ends and centre become 1000, 1500 and 2000 us, straight between") {
  CHECK(calibrated(NARROW, us_to_ticks(1100)) == us_to_ticks(1000));
  CHECK(calibrated(NARROW, us_to_ticks(1520)) == us_to_ticks(1500));
  CHECK(calibrated(NARROW, us_to_ticks(1920)) == us_to_ticks(2000));
  CHECK(calibrated(NARROW, us_to_ticks(1310)) == us_to_ticks(1250));
  CHECK(calibrated(NARROW, us_to_ticks(1720)) == us_to_ticks(1750));
}

TEST_CASE("pilot range: whatever was learned, more stick is more, and within 885 to 2115 us") {
  const ChannelRange ranges[] = {
      NARROW, {900, 1400, 1500}, {1300, 1800, 2100}, {800, 1000, 1500}, {800, 2100, 2200}};
  for (const ChannelRange& range : ranges) {
    Ticks newest = 0;
    for (int pulse = us_to_ticks(885); pulse <= us_to_ticks(2115); ++pulse) {
      const Ticks shown = calibrated(range, static_cast<Ticks>(pulse));
      REQUIRE(shown >= newest);
      REQUIRE(shown >= us_to_ticks(885));
      REQUIRE(shown <= us_to_ticks(2115));
      newest = shown;
    }
  }
}

TEST_CASE("pilot range: the ends of this receiver are learned, and the sticks' resting place") {
  PilotBench bench;
  bench.run(100);
  CHECK_FALSE(bench.reader.is_learning());
  move_all(bench, NARROW, 1920);
  CHECK(bench.reader.is_learning());
  Calibration learned = DEFAULT_CALIBRATION;
  REQUIRE(bench.reader.end_range_learning(learned));
  CHECK_FALSE(bench.reader.is_learning());
  CHECK_FALSE(bench.reader.end_range_learning(learned));
  for (uint8_t i = 0; i < INPUTS; ++i) {
    CAPTURE(i);
    CHECK(std::abs(learned.receiver[i].lowest_us - 1100) <= 1);
    CHECK(std::abs(learned.receiver[i].highest_us - 1920) <= 1);
    const bool has_rest = i == AILERONS || i == ELEVATOR || i == RUDDER;
    CHECK(std::abs(learned.receiver[i].centre_us - (has_rest ? 1520 : 1510)) <= 1);
  }
  bench.calibration = learned;
  bench.sticks[AILERONS] = 1920;
  bench.run(100);
  CHECK(std::abs(bench.reader.pulse(AILERONS) - us_to_ticks(2000)) <= 4);
}

TEST_CASE("pilot range: one range that is too small keeps nothing of all") {
  PilotBench bench;
  bench.run(100);
  move_all(bench, NARROW, 1480);
  Calibration learned = DEFAULT_CALIBRATION;
  CHECK_FALSE(bench.reader.end_range_learning(learned));
  CHECK(learned.receiver[AILERONS].lowest_us == 1000);
  CHECK_FALSE(bench.reader.is_learning());
}

TEST_CASE("pilot range: a stick that rests within 200 us of its end gives no centre") {
  for (uint16_t rest_us : {uint16_t{1280}, uint16_t{1740}}) {
    PilotBench bench;
    bench.run(100);
    move_all(bench, NARROW, 1920);
    bench.sticks[ELEVATOR] = rest_us;
    bench.run(100);
    Calibration learned = DEFAULT_CALIBRATION;
    CHECK_FALSE(bench.reader.end_range_learning(learned));
  }
}

TEST_CASE("pilot range: an end that never began and a receiver that is off learn nothing") {
  PilotBench bench;
  bench.run(100);
  Calibration learned = DEFAULT_CALIBRATION;
  CHECK_FALSE(bench.reader.end_range_learning(learned));
  bench.is_on = false;
  bench.reader.begin_range_learning();
  bench.run(1000);
  CHECK_FALSE(bench.reader.end_range_learning(learned));
}

TEST_CASE("pilot range: a pulse cut by noise does not become an end point") {
  PilotBench bench;
  bench.run(100);
  move_all(bench, NARROW, 1920);
  const double at_us = static_cast<double>(bench.now_us + 8000);
  bench.is_on = false;
  bench.run(4);
  bench.lines.pulse(at_us, AILERONS, 900);
  bench.lines.pulse(at_us + 920, AILERONS, 600);
  bench.run(20);
  Calibration learned = DEFAULT_CALIBRATION;
  REQUIRE(bench.reader.end_range_learning(learned));
  CHECK(std::abs(learned.receiver[AILERONS].lowest_us - 1100) <= 1);
}
