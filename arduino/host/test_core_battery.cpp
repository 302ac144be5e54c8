#include <doctest/doctest.h>
#include <stdlib.h>

#include "core/battery.h"
#include "flying_board.h"
#include "store/eeprom_slot.h"

using namespace raspilot;

namespace {

/** Of a divider of 1 to 12: 13.2 V make 1.1 V. */
constexpr uint16_t FULL_SCALE_MV = 13200;
constexpr size_t VOLTAGE_AT = AT_BATTERY_MV;

Battery measured(uint16_t count, int times = 1) {
  Battery battery;
  for (int time = 0; time < times; ++time) battery.on_count(count);
  return battery;
}

struct Bench : FlyingBoard {
  void measure(uint16_t count) {
    for (int time = 0; time < 1000; ++time) autopilot.battery.on_count(count);
  }
  /** 0 for a confirmation, otherwise the code of the refusal. */
  int calibrate(uint16_t mv) {
    frames.clear();
    send('V', {static_cast<uint8_t>(mv >> 8), static_cast<uint8_t>(mv)});
    run(100);
    for (const SentFrame& each : frames) {
      if (each.payload.size() < 2 || each.payload[0] != 'V') continue;
      if (each.type == 'K') return 0;
      if (each.type == '!') return each.payload[2];
    }
    return -1;
  }
  int voltage_mv() {
    send('s');
    frames.clear();
    run(400);
    const std::vector<uint8_t> status = take('x').payload;
    REQUIRE(status.size() == STATUS_SIZE);
    return status[VOLTAGE_AT] << 8 | status[VOLTAGE_AT + 1];
  }
};

struct NewBench {
  NewBench() { fake_board().reset(); }
};

struct Awake : NewBench, Bench {
  Awake() { wake(); }
};

}  // namespace

TEST_CASE("every count becomes its voltage, from the first conversion on") {
  for (uint16_t count = 1; count < 1023; ++count) {
    const double mv = FULL_SCALE_MV / 1024.0 * count;
    CHECK(std::abs(measured(count).mv(FULL_SCALE_MV) - mv) < FULL_SCALE_MV / 1024.0 + 1);
    CHECK(std::abs(measured(count, 1000).mv(FULL_SCALE_MV) - mv) < FULL_SCALE_MV / 1024.0 + 1);
  }
}

TEST_CASE("the voltage is unknown without a divider, without a conversion and at the ADC's end") {
  CHECK(measured(700).mv(0) == 0);
  CHECK(Battery().mv(FULL_SCALE_MV) == 0);
  CHECK(measured(1023, 3).mv(65535) == 0);
  Battery battery = measured(700, 1000);
  battery.on_count(1023);
  CHECK(battery.mv(FULL_SCALE_MV) == 0);
  battery.on_count(700);
  CHECK(battery.mv(FULL_SCALE_MV) == doctest::Approx(9023).epsilon(0.002));
}

TEST_CASE("a step is followed in the filter's 64 conversions") {
  Battery battery = measured(600, 1000);
  const int before = battery.mv(FULL_SCALE_MV);
  for (int time = 0; time < 64; ++time) battery.on_count(500);
  const double part = (before - battery.mv(FULL_SCALE_MV)) / (FULL_SCALE_MV / 1024.0 * 100);
  CHECK(part == doctest::Approx(0.632).epsilon(0.03));
}

TEST_CASE("a calibrated battery has the voltage that was measured") {
  for (const uint16_t count : {uint16_t{200}, uint16_t{640}, uint16_t{1022}}) {
    for (const uint16_t mv : {uint16_t{6000}, uint16_t{8400}, uint16_t{12600}}) {
      const Battery battery = measured(count, 1000);
      uint16_t full_scale_mv = 1;
      REQUIRE(battery.calibrate(mv, full_scale_mv));
      CHECK(mv - battery.mv(full_scale_mv) <= 1);
      CHECK(mv >= battery.mv(full_scale_mv));
    }
  }
}

TEST_CASE("no calibration without a measured voltage: the scale stays") {
  for (const Battery& battery :
       {Battery(), measured(0, 10), measured(1023), measured(190, 1000)}) {
    uint16_t full_scale_mv = FULL_SCALE_MV;
    CHECK_FALSE(battery.calibrate(12600, full_scale_mv));
    CHECK(full_scale_mv == FULL_SCALE_MV);
  }
}

TEST_CASE("V calibrates, the status has the voltage, and EEPROM keeps the scale") {
  Awake board;
  board.measure(640);
  CHECK(board.voltage_mv() == 0);
  CHECK(board.calibrate(8000) == 0);
  CHECK(std::abs(board.voltage_mv() - 8000) <= 1);
  board.run(2000);
  REQUIRE_FALSE(board.autopilot.settings.is_saving());
  Bench next;
  next.measure(320);
  CHECK(std::abs(next.voltage_mv() - 4000) <= 6);
  CHECK(next.calibrate(0) == 0);
  CHECK(next.voltage_mv() == 0);
}

TEST_CASE("V is refused in flight, and without a battery at the pin") {
  Awake board;
  CHECK(board.calibrate(8000) == static_cast<int>(Reason::BATTERY_NOT_MEASURED));
  board.measure(640);
  board.flick_aux2();
  REQUIRE(board.autopilot.authority.is_armed());
  CHECK(board.calibrate(8000) == static_cast<int>(Reason::ONLY_ON_GROUND));
  CHECK(board.autopilot.settings.battery_full_scale_mv == 0);
}

TEST_CASE("a scale that cannot be read makes the voltage unknown and does not veto arming") {
  fake_board().reset();
  for (uint8_t slot = 0; slot < SLOTS_A_KIND; ++slot) {
    fake_board().eeprom[slot_address(3, slot)] = SLOT_MARK;
  }
  Bench board;
  board.measure(640);
  CHECK_FALSE(board.autopilot.settings.is_broken());
  CHECK(board.voltage_mv() == 0);
}
