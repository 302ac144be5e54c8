#include <doctest/doctest.h>

#include <random>

#include "pilot_bench.h"

using namespace raspilot;

namespace {

/** A reader with its lines, without Authority; slots are run by the test. */
struct Lines {
  explicit Lines(uint32_t begin_us = 0) : reader(calibration), lines(reader, begin_us) {}

  void run_to(uint64_t end_us) {
    while (now_us + 2000 <= end_us) lines.slot(now_us += 2000);
  }
  uint16_t us(Channel channel) const { return ticks_to_us(reader.pulse(channel)); }
  bool is_valid(Channel channel) const { return reader.validity() & 1 << channel; }

  Calibration calibration = DEFAULT_CALIBRATION;
  PwmReader reader;
  ReceiverLines lines;
  uint64_t now_us = 0;
};

/** After an edge on an otherwise unused line: the first edge of all only shows the levels. */
struct AwakeLines : Lines {
  AwakeLines() {
    run_to(4000);
    lines.edge(8100, AUX2, true);
    lines.edge(8110, AUX2, false);
    run_to(8000);
  }
};

}  // namespace

TEST_CASE("pilot reader: before the first pulse sticks are centred, throttle low, nothing valid") {
  Lines bench;
  bench.run_to(2000000);
  CHECK(bench.us(AILERONS) == 1500);
  CHECK(bench.us(THROTTLE) == 1000);
  CHECK(bench.reader.validity() == 0);
  CHECK(bench.reader.measured_us(AILERONS) == 0);
  CHECK(bench.reader.age_ms(bench.lines.clock_us(bench.now_us)) == 65535);
}

TEST_CASE("pilot reader: six channels one after the other, wherever the clock stands") {
  for (uint32_t begin_us : {0u, 20000u, 0xFFFFFFFFu - 90000u, 0x7FFFF000u, 32768u * 77u - 60000u}) {
    CAPTURE(begin_us);
    PilotBench bench(begin_us);
    const uint16_t sticks[INPUTS] = {1000, 1234, 1111, 1999, 2000, 1500};
    std::copy(sticks, sticks + INPUTS, bench.sticks);
    bench.run(200);
    CHECK(bench.reader.validity() == ALL_INPUTS);
    for (uint8_t i = 0; i < INPUTS; ++i) {
      CHECK(bench.reader.measured_us(static_cast<Channel>(i)) == sticks[i]);
      CHECK(ticks_to_us(bench.reader.pulse(static_cast<Channel>(i))) == sticks[i]);
    }
  }
}

TEST_CASE("pilot reader: six channels that rise at the same moment") {
  Lines bench;
  for (uint64_t at_us = 4000; at_us < 100000; at_us += 20000) {
    for (uint8_t i = 0; i < INPUTS; ++i) {
      bench.lines.pulse(static_cast<double>(at_us), i, i < 3 ? 1500 : 1200 + 50 * i);
    }
  }
  bench.run_to(110000);
  CHECK(bench.reader.validity() == ALL_INPUTS);
  CHECK(bench.us(AILERONS) == 1500);
  CHECK(bench.us(THROTTLE) == 1500);
  CHECK(bench.us(AUX2) == 1450);
}

TEST_CASE("pilot reader: pulses count from 885 to 2115 us") {
  for (int width : {885, 2115, 884, 2116, 400, 2600}) {
    CAPTURE(width);
    AwakeLines bench;
    bench.lines.pulse(30000, ELEVATOR, 1400);
    bench.lines.pulse(50000, ELEVATOR, width);
    bench.run_to(56000);
    const bool is_good = width >= 885 && width <= 2115;
    CHECK(bench.is_valid(ELEVATOR) == is_good);
    CHECK(bench.us(ELEVATOR) == (is_good ? width : 1400));
    CHECK(bench.reader.measured_us(ELEVATOR) == width);
  }
}

TEST_CASE("pilot reader: a lost channel is seen within 100 ms, alone") {
  PilotBench bench;
  bench.run(500);
  for (uint64_t at_us = bench.next_frame_us; at_us < 700000; at_us += 20000) {
    for (uint8_t i = 0; i < INPUTS; ++i) {
      if (i != RUDDER) bench.lines.pulse(static_cast<double>(at_us + 1600u * i), i, 1500);
    }
  }
  bench.is_on = false;
  bench.run(70);
  CHECK(bench.reader.validity() == ALL_INPUTS);
  bench.run(30);
  CHECK(bench.reader.validity() == (ALL_INPUTS & ~(1 << RUDDER)));
}

TEST_CASE("pilot reader: a line that stays high or low is lost within 100 ms and keeps its value") {
  for (bool is_high : {false, true}) {
    AwakeLines bench;
    for (uint64_t at_us = 20000; at_us <= 200000; at_us += 20000) {
      bench.lines.pulse(static_cast<double>(at_us), THROTTLE, 1700);
    }
    if (is_high) bench.lines.edge(440000, THROTTLE, true);
    bench.run_to(290000);
    CHECK(bench.is_valid(THROTTLE));
    bench.run_to(is_high ? 320000 : 302000);
    CHECK_FALSE(bench.is_valid(THROTTLE));
    CHECK(bench.us(THROTTLE) == 1700);
  }
}

TEST_CASE("pilot reader: a pulse longer than the wrap of the stamps is rejected") {
  for (double too_long_us : {32768 + 1500.0, 65536 + 1200.0, 2 * 65536 + 1500.0}) {
    AwakeLines bench;
    bench.lines.pulse(30000, RUDDER, 1600);
    bench.lines.pulse(50000, RUDDER, too_long_us);
    bench.run_to(50000 + static_cast<uint64_t>(too_long_us) + 6000);
    CHECK(bench.us(RUDDER) == 1600);
    CHECK(bench.reader.measured_us(RUDDER) == 1600);
  }
}

TEST_CASE("pilot reader: a measurement across a stalled loop is discarded") {
  AwakeLines bench;
  bench.lines.pulse(30000, RUDDER, 1600);
  bench.run_to(38000);
  bench.lines.pulse(40000, RUDDER, 32768 + 1200.0);
  bench.lines.slot(bench.now_us = 40000 + 32768 + 1200 + 500);
  CHECK(bench.us(RUDDER) == 1600);
}

TEST_CASE("pilot reader: a stall without edges does not hide how long a pulse was") {
  AwakeLines bench;
  bench.lines.pulse(30000, RUDDER, 1600);
  bench.lines.pulse(40500, RUDDER, 32768 + 1200.0);
  bench.run_to(42000);
  bench.lines.slot(bench.now_us = 40500 + 32768 + 600);
  bench.run_to(80000);
  CHECK(bench.us(RUDDER) == 1600);
}

TEST_CASE("pilot reader: lost edges make no pulse") {
  SUBCASE("told: the fall came while the ring was full") {
    AwakeLines bench;
    bench.lines.pulse(30000, AILERONS, 1100);
    bench.run_to(48000);
    bench.lines.edge(100000, AILERONS, true);
    bench.run_to(52000);
    bench.reader.on_lost_edges();
    // The snapshot of another channel's edge shows AILERONS low, long after it fell.
    bench.lines.edge(2 * 52100, ELEVATOR, true);
    bench.lines.edge(2 * 52100, AILERONS, false);
    bench.lines.edge(2 * 53600, ELEVATOR, false);
    bench.run_to(60000);
    CHECK(bench.us(AILERONS) == 1100);
    CHECK_FALSE(bench.is_valid(ELEVATOR));
    bench.lines.pulse(70000, AILERONS, 1200);
    bench.run_to(78000);
    CHECK(bench.us(AILERONS) == 1200);
  }
  SUBCASE("not told: fall and rise of two pulses") {
    AwakeLines bench;
    bench.lines.pulse(30000, AILERONS, 1100);
    bench.lines.edge(100000, AILERONS, true);
    bench.lines.edge(2 * 71500, AILERONS, false);
    bench.run_to(80000);
    CHECK(bench.us(AILERONS) == 1100);
  }
  SUBCASE("a pulse that was under way when listening began") {
    Lines bench;
    bench.run_to(2000);
    bench.lines.edge(5000, AILERONS, true);
    bench.lines.edge(2 * 2500 + 2 * 1000, AILERONS, false);
    bench.run_to(8000);
    CHECK_FALSE(bench.is_valid(AILERONS));
  }
}

TEST_CASE("pilot reader: a pulse cut in two by noise is taken back") {
  AwakeLines bench;
  for (uint64_t at_us = 20000; at_us < 100000; at_us += 20000) {
    bench.lines.pulse(static_cast<double>(at_us), ELEVATOR, 1800);
  }
  // 1000 us, a gap of 30 us, 970 us: both pieces look like pulses.
  bench.lines.pulse(100000, ELEVATOR, 1000);
  bench.lines.pulse(101030, ELEVATOR, 970);
  bench.run_to(110000);
  CHECK(bench.us(ELEVATOR) == 1800);
  CHECK(bench.is_valid(ELEVATOR));
  bench.lines.pulse(120000, ELEVATOR, 1850);
  bench.run_to(130000);
  CHECK(bench.us(ELEVATOR) == 1850);
}

TEST_CASE("pilot reader: a storm on one pin fakes no pulse there and harms no other") {
  std::mt19937 random(7);
  for (double mean_us : {40.0, 150.0, 400.0, 700.0}) {
    CAPTURE(mean_us);
    PilotBench bench;
    bench.sticks[RUDDER] = 1750;
    bench.run(400);
    bench.is_on = false;
    std::exponential_distribution<double> gap_us(1 / mean_us);
    bool is_high = true;
    for (double at_us = 402000; at_us < 2400000; at_us += 5 + std::min(gap_us(random), 2400.0)) {
      bench.lines.edge(static_cast<uint64_t>(2 * at_us), RUDDER, is_high);
      is_high = !is_high;
    }
    for (uint64_t at_us = 404000; at_us < 2400000; at_us += 20000) {
      bench.lines.pulse(static_cast<double>(at_us), AILERONS, 1300);
    }
    int valid_slots = 0;
    bench.on_slot = [&] {
      CHECK(bench.reader.pulse(AILERONS) / 2 >= 1300);
      if (bench.now_us > 500000) valid_slots += bench.reader.validity() >> RUDDER & 1;
    };
    bench.run(2000);
    CHECK(ticks_to_us(bench.reader.pulse(AILERONS)) == 1300);
    CHECK(ticks_to_us(bench.reader.pulse(RUDDER)) == 1750);
    CHECK(valid_slots == 0);
  }
}

TEST_CASE("pilot reader: cut pulses do not keep a channel alive, nor bring one to life") {
  for (bool was_alive : {false, true}) {
    CAPTURE(was_alive);
    AwakeLines bench;
    for (uint64_t at_us = 20000; at_us < 200000 && was_alive; at_us += 20000) {
      bench.lines.pulse(static_cast<double>(at_us), RUDDER, 1600);
    }
    for (uint64_t at_us = 200000; at_us < 1200000; at_us += 10000) {
      bench.lines.pulse(static_cast<double>(at_us), RUDDER, 1000);
      bench.lines.pulse(static_cast<double>(at_us) + 1040, RUDDER, 1000);
    }
    bench.run_to(310000);
    int valid_slots = 0;
    while (bench.now_us < 1200000) {
      bench.run_to(bench.now_us + 2000);
      valid_slots += bench.is_valid(RUDDER);
    }
    CHECK(valid_slots == 0);
    CHECK(bench.us(RUDDER) == (was_alive ? 1600 : 1500));
  }
}

TEST_CASE("pilot reader: one uncertain stamp of two keeps the value; the channel is alive") {
  AwakeLines bench;
  for (uint64_t at_us = 20000; at_us < 400000; at_us += 20000) {
    const bool is_late = at_us > 60000;
    const uint64_t width_us = is_late ? 1503 : 1500;
    bench.lines.edge(2 * at_us, AILERONS, true, is_late && at_us % 40000 != 0);
    bench.lines.edge(2 * (at_us + width_us), AILERONS, false, is_late && at_us % 40000 == 0);
  }
  bench.run_to(400000);
  CHECK(bench.us(AILERONS) == 1500);
  CHECK(bench.is_valid(AILERONS));
}

TEST_CASE("pilot reader: an output follows each rise of a good channel once") {
  PilotBench bench;
  bench.run(100);
  uint16_t stamp = 0;
  int rises = 0;
  bench.on_slot = [&] {
    if (!bench.reader.take_rise(ELEVATOR, stamp)) return;
    ++rises;
    CHECK_FALSE(bench.reader.take_rise(ELEVATOR, stamp));
    const uint64_t frame_us = (bench.now_us - 4000) / 20000 * 20000 + 4000;
    CHECK(stamp == static_cast<uint16_t>(2 * (frame_us + 1500)));
  };
  bench.run(1000);
  CHECK(rises >= 50);
  CHECK(rises <= 51);
  bench.sticks[ELEVATOR] = 2300;
  bench.run(60);
  rises = 0;
  bench.run(400);
  CHECK(rises == 0);
}

TEST_CASE("pilot reader: noise between pulses raises no output") {
  AwakeLines bench;
  for (uint64_t at_us = 20000; at_us < 60000; at_us += 20000) {
    bench.lines.pulse(static_cast<double>(at_us), AILERONS, 1500);
  }
  bench.run_to(52000);
  uint16_t stamp;
  bench.reader.take_rise(AILERONS, stamp);
  bench.lines.pulse(53000, AILERONS, 20);
  bench.run_to(56000);
  CHECK_FALSE(bench.reader.take_rise(AILERONS, stamp));
  CHECK(bench.reader.measured_us(AILERONS) == 1500);
}

TEST_CASE("pilot reader: the age of the newest pulses counts and stays at its end") {
  PilotBench bench;
  bench.run(100);
  CHECK(bench.reader.age_ms(bench.clock_us()) <= 20);
  bench.is_on = false;
  bench.run(1000);
  const uint16_t age_ms = bench.reader.age_ms(bench.clock_us());
  CHECK(age_ms >= 980);
  CHECK(age_ms <= 1020);
  bench.run(66000);
  CHECK(bench.reader.age_ms(bench.clock_us()) == 65535);
  CHECK(bench.reader.age_ms(bench.clock_us() + 1000000) == 65535);
}

TEST_CASE("pilot reader: any edges at any time leave pulses within range") {
  std::mt19937 random(11);
  for (int round = 0; round < 20; ++round) {
    Lines bench(static_cast<uint32_t>(random()));
    std::uniform_int_distribution<uint64_t> at(0, 2 * 1000000);
    for (int i = 0; i < 3000; ++i) {
      bench.lines.edge(at(random), static_cast<uint8_t>(random() % INPUTS), random() & 1,
                       random() & 1);
    }
    while (bench.now_us < 1000000) {
      bench.lines.slot(bench.now_us += random() % 9 == 0 ? 40000 : 2000);
      for (uint8_t i = 0; i < INPUTS; ++i) {
        const Ticks pulse = bench.reader.pulse(static_cast<Channel>(i));
        REQUIRE(pulse >= us_to_ticks(885));
        REQUIRE(pulse <= us_to_ticks(2115));
      }
      if (random() % 50 == 0) bench.reader.on_lost_edges();
    }
  }
}
