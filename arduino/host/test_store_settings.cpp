#include <doctest/doctest.h>
#include <string.h>

#include "fake_board.h"
#include "store/eeprom_slot.h"
#include "store/settings.h"

using namespace raspilot;

namespace {

constexpr uint32_t LOOK_US = 500;

/** Runs the background until all is saved; false when it takes more than 10 s. */
bool save_all(Settings& settings) {
  for (uint32_t us = 0; us < 10000000; us += LOOK_US) {
    if (!settings.is_saving()) return true;
    settings.background(false);
    fake_board().elapse(LOOK_US);
  }
  return false;
}

Settings reloaded() {
  fake_board().power_on();
  Settings settings;
  settings.load();
  return settings;
}

void save_gain(Settings& settings, float gain) {
  settings.gains.rate[0].p = gain;
  settings.save_gains();
}

/** A board whose EEPROM holds the gains 1, then 2. */
Settings with_two_copies() {
  fake_board().reset();
  Settings settings = reloaded();
  save_gain(settings, 1);
  REQUIRE(save_all(settings));
  save_gain(settings, 2);
  REQUIRE(save_all(settings));
  return settings;
}

/** Runs the background until `writes` bytes have been written. */
void write_bytes(Settings& settings, uint32_t writes) {
  const uint32_t end = fake_board().writes + writes;
  for (uint32_t look = 0; fake_board().writes < end && look < 100000; ++look) {
    settings.background(false);
    fake_board().elapse(LOOK_US);
  }
  REQUIRE(fake_board().writes == end);
}

}  // namespace

TEST_CASE("an erased EEPROM gives the defaults and nothing is broken") {
  fake_board().reset();
  const Settings settings = reloaded();
  CHECK_FALSE(settings.has_gains());
  CHECK_FALSE(settings.has_calibration());
  CHECK_FALSE(settings.is_broken());
  CHECK_FALSE(settings.is_saving());
  CHECK(settings.gains.rate[0].p == DEFAULT_GAINS.rate[0].p);
  CHECK(settings.profile.throttle_lost_us == DEFAULT_PROFILE.throttle_lost_us);
  CHECK(settings.calibration.receiver[AUX2].highest_us == 2000);
  CHECK(fake_board().violations == 0);
}

TEST_CASE("saved settings are loaded at the next power-on, each kind separately") {
  fake_board().reset();
  Settings settings = reloaded();
  settings.profile.has_motor = false;
  settings.profile.roll_limit_cdeg = 3210;
  settings.save_profile();
  REQUIRE(save_all(settings));
  CHECK_FALSE(settings.has_gains());
  save_gain(settings, 12.5f);
  settings.calibration.level_roll_cdeg = -77;
  settings.save_calibration();
  REQUIRE(save_all(settings));
  CHECK(settings.has_gains());
  CHECK(settings.has_calibration());
  const Settings later = reloaded();
  CHECK_FALSE(later.profile.has_motor);
  CHECK(later.profile.roll_limit_cdeg == 3210);
  CHECK(later.gains.rate[0].p == 12.5f);
  CHECK(later.calibration.level_roll_cdeg == -77);
  CHECK(later.has_gains());
  CHECK(later.has_calibration());
  CHECK_FALSE(later.is_broken());
  CHECK(fake_board().violations == 0);
}

TEST_CASE("the newest of very many saves is loaded, and saves wear both slots alike") {
  fake_board().reset();
  Settings settings = reloaded();
  for (int count = 1; count <= 600; ++count) {
    save_gain(settings, static_cast<float>(count % 50) + 0.5f);
    REQUIRE(save_all(settings));
    REQUIRE(reloaded().gains.rate[0].p == settings.gains.rate[0].p);
  }
  CHECK(fake_board().violations == 0);
}

TEST_CASE("a power cut at any byte of a save leaves the copy before, or the new one whole") {
  Settings measured = with_two_copies();
  save_gain(measured, 3);
  for (uint8_t axis = 0; axis < 3; ++axis) measured.gains.stabilize[axis].i = 1.7f;
  const uint32_t written = fake_board().writes;
  REQUIRE(save_all(measured));
  const uint32_t writes_of_save = fake_board().writes - written;
  // The cell that was being written may hold anything afterwards.
  for (int torn : {-1, 0x00, 0xFF, 0xA5, 0x5A}) {
    bool is_whole = false;
    for (uint32_t cut = 0; !is_whole; ++cut) {
      CAPTURE(cut);
      CAPTURE(torn);
      Settings settings = with_two_copies();
      save_gain(settings, 3);
      for (uint8_t axis = 0; axis < 3; ++axis) settings.gains.stabilize[axis].i = 1.7f;
      write_bytes(settings, cut);
      if (cut > 0 && torn >= 0) {
        fake_board().eeprom[fake_board().newest_address] = static_cast<uint8_t>(torn);
      }
      const Settings later = reloaded();
      REQUIRE(later.has_gains());
      const float gain = later.gains.rate[0].p;
      const bool is_old = gain == 2 && later.gains.stabilize[1].i == DEFAULT_GAINS.stabilize[1].i;
      const bool is_new = gain == 3 && later.gains.stabilize[1].i == 1.7f;
      const bool is_either = is_old || is_new;
      REQUIRE(is_either);
      // Settings are saved again after the cut as ever.
      Settings again = later;
      save_gain(again, 4);
      REQUIRE(save_all(again));
      REQUIRE(reloaded().gains.rate[0].p == 4);
      // The mark is last, so that only the last byte makes the new copy valid; torn, it is not.
      if (is_new) CHECK(cut >= 13);
      is_whole = is_new || cut == writes_of_save;
    }
  }
}

TEST_CASE("EEPROM is not written while armed; a save interrupted by arming starts again") {
  Settings settings = with_two_copies();
  save_gain(settings, 3);
  settings.background(true);
  const uint32_t before = fake_board().writes;
  for (int look = 0; look < 1000; ++look) {
    CHECK_FALSE(settings.background(true));
    fake_board().elapse(LOOK_US);
  }
  CHECK(fake_board().writes == before);
  CHECK(settings.is_saving());
  for (uint32_t begun = 1; begun < 6; ++begun) {
    write_bytes(settings, begun);
    for (int look = 0; look < 20; ++look) {
      settings.background(true);
      fake_board().elapse(LOOK_US);
    }
    CHECK(reloaded().gains.rate[0].p == 2);
    fake_board().power_on();
    // Gains changed in flight, in RAM only, and all of them: no byte of the slot is right yet.
    for (uint8_t axis = 0; axis < 3; ++axis) {
      const float gain = 3.3f + 1.1f * static_cast<float>(begun);
      settings.gains.rate[axis] = PidGains{gain, gain, gain};
      settings.gains.stabilize[axis] = PidGains{gain, gain, gain};
    }
  }
  REQUIRE(save_all(settings));
  CHECK(reloaded().gains.rate[0].p == settings.gains.rate[0].p);
  CHECK(reloaded().gains.stabilize[2].d == settings.gains.rate[0].p);
  CHECK(fake_board().violations == 0);
}

TEST_CASE("a kind that changes during a save is saved with its new values") {
  Settings settings = with_two_copies();
  save_gain(settings, 3);
  write_bytes(settings, 4);
  save_gain(settings, 5);
  settings.gains.stabilize[2].p = 9;
  REQUIRE(save_all(settings));
  CHECK(reloaded().gains.rate[0].p == 5);
  CHECK(reloaded().gains.stabilize[2].p == 9);
}

TEST_CASE("an unmarked change does not produce a copy of two halves") {
  Settings settings = with_two_copies();
  save_gain(settings, 3);
  write_bytes(settings, 4);
  settings.gains.rate[0].p = 40;
  settings.gains.stabilize[2].p = 41;
  REQUIRE(save_all(settings));
  const Gains later = reloaded().gains;
  CHECK(later.rate[0].p == 40);
  CHECK(later.stabilize[2].p == 41);
}

TEST_CASE("a save takes the slot's mark away first and puts it there last") {
  Settings settings = with_two_copies();
  save_gain(settings, 3);
  write_bytes(settings, 1);
  const uint8_t& mark = fake_board().eeprom[slot_address(1, 0)];
  CHECK(mark == SLOT_NO_MARK);
  uint8_t slot[GAINS_SIZE + SLOT_OVERHEAD];
  while (mark == SLOT_NO_MARK) {
    memcpy(slot, &mark, sizeof slot);
    REQUIRE(settings.is_saving());
    settings.background(false);
    fake_board().elapse(LOOK_US);
  }
  slot[0] = SLOT_MARK;
  CHECK(memcmp(slot, &mark, sizeof slot) == 0);
  REQUIRE(save_all(settings));
  CHECK(memcmp(slot, &mark, sizeof slot) == 0);
}

TEST_CASE("one flipped bit in the newest copy gives the older one") {
  with_two_copies();
  uint8_t whole[EEPROM_SIZE];
  memcpy(whole, fake_board().eeprom, sizeof whole);
  for (uint16_t bit = 0; bit < (GAINS_SIZE + SLOT_OVERHEAD) * 8; ++bit) {
    CAPTURE(bit);
    memcpy(fake_board().eeprom, whole, sizeof whole);
    fake_board().eeprom[slot_address(1, 1) + bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
    REQUIRE(reloaded().gains.rate[0].p == 1);
  }
}

TEST_CASE("copies with a correct CRC and a value out of range are rejected") {
  Settings settings = with_two_copies();
  settings.gains.rate[0].p = 51;
  settings.save_gains();
  REQUIRE(save_all(settings));
  CHECK(reloaded().gains.rate[0].p == 2);
}

TEST_CASE("an unreadable profile is reported, and repaired by a new one") {
  fake_board().reset();
  Settings settings = reloaded();
  settings.profile.has_motor = false;
  settings.save_profile();
  REQUIRE(save_all(settings));
  for (uint16_t at = 0; at < PROFILE_SIZE + SLOT_OVERHEAD; ++at) {
    fake_board().eeprom[slot_address(0, 0) + at] ^= 0x01;
    Settings broken = reloaded();
    REQUIRE(broken.is_broken());
    CHECK(broken.profile.has_motor);
    fake_board().eeprom[slot_address(0, 0) + at] ^= 0x01;
  }
  REQUIRE_FALSE(reloaded().is_broken());
  fake_board().eeprom[slot_address(0, 0)] = 0xFF;
  Settings broken = reloaded();
  REQUIRE(broken.is_broken());
  broken.save_profile();
  CHECK(broken.is_broken());
  REQUIRE(save_all(broken));
  CHECK_FALSE(broken.is_broken());
  CHECK_FALSE(reloaded().is_broken());
}

TEST_CASE("a first profile of which power left a part is broken, not absent") {
  fake_board().reset();
  Settings settings = reloaded();
  settings.profile.has_motor = false;
  settings.save_profile();
  write_bytes(settings, 5);
  CHECK(reloaded().is_broken());
}

TEST_CASE("gains and calibrations that cannot be read are broken settings") {
  fake_board().reset();
  for (uint16_t at = slot_address(1, 0); at < slot_address(3, 0); ++at) fake_board().eeprom[at] = 0;
  const Settings settings = reloaded();
  CHECK(settings.is_broken());
  CHECK_FALSE(settings.has_gains());
  CHECK_FALSE(settings.has_calibration());
}

TEST_CASE("a worn cell is given up, and the older copy stays") {
  Settings settings = with_two_copies();
  save_gain(settings, 3);
  const uint16_t worn = static_cast<uint16_t>(slot_address(1, 0) + 20);
  uint32_t looks = 0;
  for (; settings.is_saving() && looks < 100000; ++looks) {
    settings.background(false);
    fake_board().elapse(LOOK_US);
    fake_board().eeprom[worn] = 0x42;
  }
  CHECK(looks < 100000);
  CHECK(settings.has_gains());
  CHECK(settings.gains.rate[0].p == 3);
  CHECK(reloaded().gains.rate[0].p == 2);
}

TEST_CASE("no call of the background writes more than a byte, or while the EEPROM is busy") {
  Settings settings = with_two_copies();
  settings.save_profile();
  settings.save_calibration();
  save_gain(settings, 33);
  uint32_t written = fake_board().writes;
  while (settings.is_saving()) {
    settings.background(false);
    CHECK(fake_board().writes - written <= 1);
    written = fake_board().writes;
    fake_board().elapse(100);
  }
  CHECK(fake_board().violations == 0);
}

TEST_CASE("any bytes in EEPROM load without harm, and never as values out of range") {
  uint32_t random = 1;
  for (uint16_t round = 0; round < 300; ++round) {
    fake_board().reset();
    for (uint8_t& cell : fake_board().eeprom) {
      random = random * 1664525u + 1013904223u;
      cell = static_cast<uint8_t>(random >> 24);
    }
    for (uint8_t kind = 0; kind < 3; ++kind) {
      fake_board().eeprom[slot_address(kind, round & 1)] = SLOT_MARK;
      fake_board().eeprom[slot_address(kind, round & 1) + 1] = 1;
    }
    const Settings settings = reloaded();
    CHECK(settings.is_broken());
    CHECK_FALSE(settings.has_gains());
    CHECK(settings.gains.rate[0].p == DEFAULT_GAINS.rate[0].p);
  }
}
