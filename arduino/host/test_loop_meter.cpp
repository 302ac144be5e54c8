#include <doctest/doctest.h>

#include "core/loop_meter.h"

using namespace raspilot;

namespace {

/** Runs slots of 2000 us on time from `us` on; returns the moment after the last. */
uint32_t run(LoopMeter& meter, uint32_t us, uint32_t slots, uint32_t late_us = 0) {
  for (uint32_t slot = 0; slot < slots; ++slot, us += SLOT_US) meter.on_slot(us, us + late_us);
  return us;
}

}  // namespace

TEST_CASE("the meter knows nothing in its first second") {
  LoopMeter meter;
  run(meter, 5, 500, 30);
  CHECK(meter.period_us() == 0);
  CHECK(meter.late_us() == 0);
  CHECK(meter.seconds() == 0);
}

TEST_CASE("the period is the mean of the last whole second and the lateness its greatest") {
  LoopMeter meter;
  uint32_t us = run(meter, 0, 100);
  meter.on_slot(us, us + 40);
  us = run(meter, us + SLOT_US, 400);
  CHECK(meter.period_us() == 2000);
  CHECK(meter.late_us() == 40);
  CHECK(meter.seconds() == 1);
  us = run(meter, us, 500);
  CHECK(meter.late_us() == 0);
  for (int slot = 0; slot < 801; ++slot, us += 2500) meter.on_slot(us, us);
  CHECK(meter.period_us() == 2500);
}

TEST_CASE("a slot that begins before it is due is not late") {
  LoopMeter meter;
  for (uint32_t us = 2000; us < 3000000; us += SLOT_US) meter.on_slot(us, us - 1);
  CHECK(meter.late_us() == 0);
}

TEST_CASE("the meter counts seconds without drift and over the wrap of the clock") {
  LoopMeter meter;
  uint32_t us = 0xFFFFFFFFu - 10000000u;
  uint32_t wobble = 0;
  for (uint32_t slot = 0; slot <= 100 * 500; ++slot, us += SLOT_US) {
    wobble = (wobble + 37) % 50;
    meter.on_slot(us, us + wobble);
  }
  CHECK(meter.seconds() == 100);
  CHECK(meter.period_us() == 2000);
  CHECK(meter.late_us() == 49);
}

TEST_CASE("a period that does not divide a second does not shift the seconds") {
  LoopMeter meter;
  for (uint32_t us = 0; us <= 1000003000; us += 2003) meter.on_slot(us, us);
  CHECK(meter.seconds() == 1000);
  CHECK(meter.period_us() == 2003);
}

TEST_CASE("the meter's counts stay at 65535") {
  LoopMeter meter;
  uint32_t us = 0;
  for (uint32_t slot = 0; slot < 20 * 65540; ++slot, us += 50000) meter.on_slot(us, us + 500000);
  CHECK(meter.seconds() == 65535);
  CHECK(meter.late_us() == 65535);
}
