#include <doctest/doctest.h>

#include "pilot_bench.h"

using namespace raspilot;

namespace {

uint8_t vetoes(const PilotBench& bench) { return bench.authority.vetoes(); }

/** The switch moves up after a low that counts; returns after `ms`. */
void raise_aux2(PilotBench& bench, uint32_t ms) {
  bench.move(AUX2, 1000, 500);
  bench.move(AUX2, 2000, ms);
}

}  // namespace

TEST_CASE("pilot arming: an edge of AUX2 from low to high arms after 300 ms") {
  PilotBench bench;
  raise_aux2(bench, 0);
  const auto is_armed = [&] { return bench.authority.is_armed(); };
  const uint32_t took_ms = bench.run_until(is_armed, 1000);
  CHECK(took_ms >= 300);
  CHECK(took_ms <= 340);
  CHECK(vetoes(bench) == 0);
}

TEST_CASE("pilot arming: AUX2 high from the beginning does not count as an edge") {
  PilotBench bench;
  bench.move(AUX2, 2000, 5000);
  CHECK_FALSE(bench.authority.is_armed());
  CHECK(vetoes(bench) == 0);
}

TEST_CASE("pilot arming: a low or a high that is shorter than 300 ms does not count") {
  PilotBench bench;
  bench.move(AUX2, 2000, 1000);
  bench.move(AUX2, 1000, 280);
  bench.move(AUX2, 2000, 2000);
  CHECK_FALSE(bench.authority.is_armed());
  raise_aux2(bench, 280);
  bench.move(AUX2, 1000, 2000);
  CHECK_FALSE(bench.authority.is_armed());
}

TEST_CASE("pilot arming: a trembling switch is not debounced into an edge") {
  PilotBench bench;
  bench.run(500);
  for (int i = 0; i < 60; ++i) {
    bench.move(AUX2, i & 1 ? 1000 : 2000, 100);
    CHECK_FALSE(bench.authority.is_armed());
  }
}

TEST_CASE("pilot arming: the middle of AUX2 moves nothing") {
  PilotBench bench;
  bench.run(500);
  bench.move(AUX2, 1515, 1000);
  CHECK_FALSE(bench.authority.is_armed());
  bench.move(AUX2, 1530, 400);
  CHECK(bench.authority.is_armed());
  bench.move(AUX2, 1485, 1000);
  CHECK(bench.authority.is_armed());
}

TEST_CASE("pilot arming: each veto keeps it disarmed, is reported, and does not count as an edge later") {
  PilotBench bench;
  uint8_t bit = 0;
  bench.run(100);
  SUBCASE("throttle") {
    bench.sticks[THROTTLE] = 1060;
    bit = VETO_THROTTLE_NOT_LOW;
  }
  SUBCASE("IMU") {
    bench.is_imu_valid = false;
    bit = VETO_IMU_INVALID;
  }
  SUBCASE("calibrating") {
    bench.is_calibrating = true;
    bit = VETO_CALIBRATING;
  }
  SUBCASE("profile") {
    bench.is_profile_broken = true;
    bit = VETO_PROFILE_INVALID;
  }
  SUBCASE("the Raspberry Pi's") {
    bench.on_slot = [&] { bench.authority.accept_veto(true); };
    bit = VETO_RASPBERRY_PI;
  }
  raise_aux2(bench, 500);
  CHECK_FALSE(bench.authority.is_armed());
  CHECK(vetoes(bench) == bit);
  CHECK(bench.arm() != Reason::NONE);
  CHECK_FALSE(bench.authority.is_armed());
  bench.on_slot = nullptr;
  bench.authority.accept_veto(false);
  bench.sticks[THROTTLE] = 1000;
  bench.is_imu_valid = true;
  bench.is_calibrating = bench.is_profile_broken = false;
  bench.run(2000);
  CHECK(vetoes(bench) == 0);
  CHECK_FALSE(bench.authority.is_armed());
  raise_aux2(bench, 500);
  CHECK(bench.authority.is_armed());
}

TEST_CASE("pilot arming: a receiver that is off or in its own failsafe vetoes") {
  PilotBench bench;
  bench.move(AUX2, 2000, 1000);
  REQUIRE(vetoes(bench) == 0);
  SUBCASE("off") { bench.is_on = false; }
  SUBCASE("one channel out of range") { bench.sticks[RUDDER] = 2200; }
  SUBCASE("its own failsafe") { bench.sticks[THROTTLE] = 890; }
  bench.run(200);
  CHECK((vetoes(bench) & VETO_RECEIVER_INVALID) != 0);
  CHECK(bench.arm() == Reason::RECEIVER_INVALID);
  CHECK_FALSE(bench.authority.is_armed());
}

TEST_CASE("pilot arming: a Command arms when there is no veto") {
  PilotBench bench;
  bench.move(AUX2, 2000, 1000);
  Reason reason = Reason::NONE;
  SUBCASE("nothing does") {}
  SUBCASE("throttle") {
    bench.sticks[THROTTLE] = 1300;
    reason = Reason::THROTTLE_NOT_LOW;
  }
  SUBCASE("IMU") {
    bench.is_imu_valid = false;
    reason = Reason::IMU_INVALID;
  }
  SUBCASE("AUX2 low, for one frame already") {
    bench.sticks[AUX2] = 1000;
    reason = Reason::VETO;
  }
  SUBCASE("calibrating") {
    bench.is_calibrating = true;
    reason = Reason::VETO;
  }
  SUBCASE("profile") {
    bench.is_profile_broken = true;
    reason = Reason::VETO;
  }
  bench.run(40);
  CHECK(bench.arm() == reason);
  CHECK(bench.authority.is_armed() == (reason == Reason::NONE));
}

TEST_CASE("pilot arming: a Command cannot arm before the receiver was received") {
  PilotBench bench;
  bench.is_on = false;
  bench.run(1000);
  CHECK(bench.arm() == Reason::RECEIVER_INVALID);
  CHECK_FALSE(bench.authority.is_armed());
}

TEST_CASE("pilot arming: the Raspberry Pi's veto ends after a second without another") {
  PilotBench bench;
  bench.move(AUX2, 2000, 1000);
  bench.authority.accept_veto(true);
  bench.run(990);
  CHECK(vetoes(bench) == VETO_RASPBERRY_PI);
  CHECK(bench.arm() == Reason::VETO);
  bench.run(20);
  CHECK(vetoes(bench) == 0);
}

TEST_CASE("pilot arming: disarmed, the motor gets 1000 us whatever stick and Raspberry Pi do") {
  FlyingBench bench(2000, false);
  for (uint16_t throttle = 885; throttle <= 2115; throttle = static_cast<uint16_t>(throttle + 30)) {
    bench.move(THROTTLE, throttle, 40);
    CHECK(bench.output(1500, 1800) != Reason::NONE);
    CHECK(bench.demand(0, 1800) != Reason::NONE);
    CHECK(bench.throttle_us() == 1000);
  }
}

TEST_CASE("pilot arming: armed, the throttle is the stick's") {
  FlyingBench bench(1000);
  REQUIRE(bench.authority.is_armed());
  for (uint16_t throttle : {uint16_t{1000}, uint16_t{1404}, uint16_t{2000}, uint16_t{1100}}) {
    bench.move(THROTTLE, throttle, 60);
    CHECK(bench.throttle_us() == throttle);
  }
}

TEST_CASE("pilot arming: the ground disarms only after 2 s of low throttle that was seen") {
  FlyingBench bench(1000);
  bench.move(THROTTLE, 1500, 3000);
  CHECK(bench.disarm() == Reason::THROTTLE_NOT_LOW);
  bench.move(THROTTLE, 1000, 1900);
  CHECK(bench.disarm() == Reason::THROTTLE_NOT_LOW);
  CHECK(bench.authority.is_armed());
  SUBCASE("the stick is raised in between") {
    bench.move(THROTTLE, 1200, 40);
    bench.move(THROTTLE, 1000, 1900);
    CHECK(bench.disarm() == Reason::THROTTLE_NOT_LOW);
  }
  SUBCASE("the receiver is lost: the stick is unknown") {
    bench.is_on = false;
    bench.run(3000);
    CHECK(bench.disarm() == Reason::RECEIVER_INVALID);
    CHECK(bench.authority.is_armed());
    bench.is_on = true;
    bench.run(1000);
    CHECK(bench.disarm() == Reason::THROTTLE_NOT_LOW);
    bench.run(1000);
  }
  bench.run(150);
  CHECK(bench.disarm() == Reason::NONE);
  CHECK_FALSE(bench.authority.is_armed());
  CHECK(bench.disarm() == Reason::NONE);
}

TEST_CASE("pilot arming: the time of low throttle does not wrap") {
  FlyingBench bench(1000);
  bench.run(70000);
  CHECK(bench.disarm() == Reason::NONE);
}

TEST_CASE("pilot arming: AUX2 low for 300 ms disarms, whatever the throttle") {
  FlyingBench bench(2000);
  bench.move(THROTTLE, 1900, 500);
  bench.move(AUX2, 1000, 280);
  CHECK(bench.authority.is_armed());
  CHECK(bench.throttle_us() == 1900);
  bench.run(60);
  CHECK_FALSE(bench.authority.is_armed());
  CHECK(bench.throttle_us() == 1000);
}

TEST_CASE("pilot arming: neither a lost IMU, a lost receiver nor a veto disarms") {
  FlyingBench bench(1500);
  bench.move(THROTTLE, 1600, 100);
  SUBCASE("IMU") { bench.is_imu_valid = false; }
  SUBCASE("receiver") { bench.is_on = false; }
  SUBCASE("both") { bench.is_on = bench.is_imu_valid = false; }
  SUBCASE("own failsafe with AUX2 low") {
    bench.sticks[THROTTLE] = 890;
    bench.sticks[AUX2] = 1000;
  }
  SUBCASE("vetoes") {
    bench.is_calibrating = bench.is_profile_broken = true;
    bench.on_slot = [&] { bench.authority.accept_veto(true); };
  }
  bench.run(10000);
  CHECK(bench.authority.is_armed());
}

TEST_CASE("pilot arming: the return of a receiver does not count as an edge") {
  PilotBench bench;
  SUBCASE("AUX2 was low, is high") {
    bench.run(1000);
    bench.is_on = false;
  }
  SUBCASE("its failsafe says low, its return high") {
    bench.move(AUX2, 2000, 1000);
    bench.sticks[THROTTLE] = 890;
    bench.sticks[AUX2] = 1000;
  }
  bench.run(1000);
  bench.is_on = true;
  bench.sticks[THROTTLE] = 1000;
  bench.move(AUX2, 2000, 2000);
  CHECK(bench.authority.has_receiver());
  CHECK_FALSE(bench.authority.is_armed());
  raise_aux2(bench, 400);
  CHECK(bench.authority.is_armed());
}

TEST_CASE("pilot arming: a low before a loss of 200 ms and a high after it do not count as an edge") {
  PilotBench bench;
  bench.run(1000);
  bench.is_on = false;
  bench.run(200);
  bench.is_on = true;
  bench.move(AUX2, 2000, 1000);
  CHECK_FALSE(bench.authority.is_armed());
}

TEST_CASE("pilot arming: a glider's channel and authority need no arming, its arming no throttle") {
  PilotBench bench;
  bench.profile.has_motor = false;
  bench.sticks[THROTTLE] = 1800;
  bench.fly(2000, false);
  CHECK(bench.throttle_us() == 1800);
  CHECK((vetoes(bench) & VETO_THROTTLE_NOT_LOW) == 0);
  CHECK(bench.output(1600, 0) == Reason::NONE);
  CHECK(bench.throttle_us() == 1800);
  CHECK(bench.output(1600, 1200) == Reason::NONE);
  CHECK(bench.throttle_us() == 1200);
  raise_aux2(bench, 400);
  CHECK(bench.authority.is_armed());
  CHECK(bench.disarm() == Reason::NONE);
  CHECK_FALSE(bench.authority.is_armed());
}
