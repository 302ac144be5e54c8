#include <doctest/doctest.h>

#include <random>

#include "control/servo_stage.h"

using namespace raspilot;

namespace {

Outputs servos(const Profile& profile, int ailerons, int elevator, int throttle, int rudder) {
  const int us[OUTPUTS] = {ailerons, elevator, throttle, rudder};
  Ticks demands[OUTPUTS];
  for (int channel = 0; channel < OUTPUTS; ++channel) {
    demands[channel] = us_to_ticks(static_cast<int16_t>(us[channel]));
  }
  Outputs outputs;
  to_servos(profile, demands, outputs);
  return outputs;
}

int us(const Outputs& outputs, Channel channel) { return ticks_to_us(outputs.ticks[channel]); }

}  // namespace

TEST_CASE("the default profile passes every half microsecond through and ends at 1000 and 2000") {
  for (int ticks = 1600; ticks <= 4400; ++ticks) {
    Ticks demands[OUTPUTS];
    for (Ticks& demand : demands) demand = static_cast<Ticks>(ticks);
    Outputs outputs;
    to_servos(DEFAULT_PROFILE, demands, outputs);
    const int expected = ticks < 2000 ? 2000 : ticks > 4000 ? 4000 : ticks;
    for (Ticks output : outputs.ticks) CHECK(output == expected);
  }
}

TEST_CASE("a servo is reversed about 1500, trimmed and kept within its end points") {
  Profile profile = DEFAULT_PROFILE;
  profile.servos[RUDDER] = {true, 30, 1200, 1900};
  CHECK(us(servos(profile, 1500, 1500, 1000, 1500), RUDDER) == 1530);
  CHECK(us(servos(profile, 1500, 1500, 1000, 1600), RUDDER) == 1430);
  CHECK(us(servos(profile, 1500, 1500, 1000, 2000), RUDDER) == 1200);
  CHECK(us(servos(profile, 1500, 1500, 1000, 1000), RUDDER) == 1900);
}

TEST_CASE("elevons subtract on the left and add on the right") {
  Profile profile = DEFAULT_PROFILE;
  profile.mix = Mix::ELEVON;
  const Outputs pulled = servos(profile, 1500, 1700, 1000, 1550);
  CHECK(us(pulled, AILERONS) == 1700);
  CHECK(us(pulled, ELEVATOR) == 1700);
  CHECK(us(pulled, RUDDER) == 1550);
  const Outputs rolled = servos(profile, 1600, 1700, 1000, 1500);
  CHECK(us(rolled, AILERONS) == 1600);
  CHECK(us(rolled, ELEVATOR) == 1800);
  profile.servos[ELEVATOR].is_reversed = true;
  CHECK(us(servos(profile, 1600, 1700, 1000, 1500), ELEVATOR) == 1200);
}

TEST_CASE("a V-tail adds on the elevator's output and subtracts on the rudder's") {
  Profile profile = DEFAULT_PROFILE;
  profile.mix = Mix::V_TAIL;
  const Outputs outputs = servos(profile, 1650, 1700, 1000, 1600);
  CHECK(us(outputs, AILERONS) == 1650);
  CHECK(us(outputs, ELEVATOR) == 1800);
  CHECK(us(outputs, RUDDER) == 1600);
}

TEST_CASE("a motor that is off stays off, whatever its end points say") {
  Profile profile = DEFAULT_PROFILE;
  profile.has_motor = true;
  profile.servos[THROTTLE] = {true, 200, 1100, 1800};
  CHECK(us(servos(profile, 1500, 1500, 1000, 1500), THROTTLE) == 1000);
  CHECK(us(servos(profile, 1500, 1500, 1050, 1500), THROTTLE) == 1100);
  CHECK(us(servos(profile, 1500, 1500, 1400, 1500), THROTTLE) == 1400);
  CHECK(us(servos(profile, 1500, 1500, 1990, 1500), THROTTLE) == 1800);
}

TEST_CASE("without a motor the third channel is a servo like the others") {
  Profile profile = DEFAULT_PROFILE;
  profile.has_motor = false;
  profile.servos[THROTTLE] = {true, 20, 1000, 2000};
  CHECK(us(servos(profile, 1500, 1500, 1000, 1500), THROTTLE) == 2000);
  CHECK(us(servos(profile, 1500, 1500, 1600, 1500), THROTTLE) == 1420);
}

TEST_CASE("no demand and no profile lets a servo out of its end points") {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> any(-32768, 32767);
  for (int round = 0; round < 20000; ++round) {
    Profile profile = DEFAULT_PROFILE;
    profile.mix = static_cast<Mix>(random() % 3);
    profile.has_motor = random() % 2 != 0;
    for (ServoSetup& servo : profile.servos) {
      servo.is_reversed = random() % 2 != 0;
      servo.trim_us = static_cast<int16_t>(static_cast<int>(random() % 401) - 200);
      servo.lowest_us = static_cast<uint16_t>(800 + random() % 700);
      servo.highest_us = static_cast<uint16_t>(servo.lowest_us + 1 + random() % 600);
    }
    Ticks demands[OUTPUTS];
    for (Ticks& demand : demands) demand = static_cast<Ticks>(any(random));
    Outputs outputs;
    to_servos(profile, demands, outputs);
    for (int channel = 0; channel < OUTPUTS; ++channel) {
      if (profile.has_motor && demands[channel] == 2000 && channel == THROTTLE) continue;
      CHECK(outputs.ticks[channel] >= profile.servos[channel].lowest_us * 2);
      CHECK(outputs.ticks[channel] <= profile.servos[channel].highest_us * 2);
    }
  }
}
