#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "control/fixed_point.h"
#include "control/flight_controller.h"
#include "moving_imu.h"

using namespace raspilot;

namespace {

constexpr int SLOTS_TO_TUNE = 5;

/** As the attitude filter gives it: hundredths of a degree, sixteenths of a deg/s. */
Attitude attitude_of(int roll, int pitch, int yaw, int p, int q, int r) {
  const auto part = [](double value) { return static_cast<int16_t>(std::lround(value * 16384)); };
  const double bank = roll / 100.0 * DEG;
  const double nose = pitch / 100.0 * DEG;
  return {static_cast<int16_t>(roll), static_cast<int16_t>(pitch), static_cast<int16_t>(yaw),
          static_cast<int16_t>(p),    static_cast<int16_t>(q),     static_cast<int16_t>(r),
          part(std::sin(bank)),       part(std::cos(bank)),        part(std::sin(nose)),
          part(std::cos(nose))};
}

/** A controller with sticks and an attitude that the test moves. */
struct Flight {
  Profile profile = DEFAULT_PROFILE;
  Gains gains = DEFAULT_GAINS;
  FlightController controller{profile, gains};
  Demand demand{};
  Attitude attitude = attitude_of(0, 0, 0, 0, 0, 0);

  Flight() {
    demand.mode = Mode::FBW;
    demand.is_imu_valid = true;
    stick(AILERONS, 1500);
    stick(ELEVATOR, 1500);
    stick(THROTTLE, 1400);
    stick(RUDDER, 1500);
    demand.throttle = us_to_ticks(1400);
  }
  explicit Flight(const Gains& tuned) : Flight() { tune(tuned); }
  void tune(const Gains& changed) {
    gains = changed;
    controller.on_gains();
    for (int slot = 0; slot < SLOTS_TO_TUNE; ++slot) controller.update(demand, attitude);
  }
  void stick(Channel channel, int us) { demand.sticks[channel] = static_cast<Ticks>(us * 2); }
  void ask(Channel channel, int us) { demand.asked.outputs.ticks[channel] = static_cast<Ticks>(us * 2); }
  void fly(int slots) {
    for (; slots > 0; --slots) controller.update(demand, attitude);
  }
  double us(Channel channel) { return controller.update(demand, attitude).ticks[channel] / 2.0; }
};

Gains only_p(float rate, float stabilize) {
  Gains gains = Gains();
  for (int axis = 0; axis < 3; ++axis) {
    gains.rate[axis].p = rate;
    gains.stabilize[axis].p = stabilize;
  }
  return gains;
}

}  // namespace

TEST_CASE("before the first slot the surfaces are neutral and the motor is off") {
  const Flight flight;
  const Outputs& outputs = flight.controller.outputs();
  CHECK(outputs.ticks[AILERONS] == 3000);
  CHECK(outputs.ticks[ELEVATOR] == 3000);
  CHECK(outputs.ticks[THROTTLE] == 2000);
  CHECK(outputs.ticks[RUDDER] == 3000);
}

TEST_CASE("ACRO passes the sticks through to the half microsecond, whatever the attitude") {
  Flight flight;
  flight.demand.mode = Mode::ACRO;
  flight.attitude = attitude_of(17000, -8000, 100, 3000, -3000, 3000);
  for (int ticks = 2000; ticks <= 4000; ++ticks) {
    flight.demand.sticks[AILERONS] = static_cast<Ticks>(ticks);
    flight.demand.sticks[ELEVATOR] = static_cast<Ticks>(6000 - ticks);
    flight.demand.sticks[RUDDER] = static_cast<Ticks>(ticks);
    const Outputs& outputs = flight.controller.update(flight.demand, flight.attitude);
    CHECK(outputs.ticks[AILERONS] == ticks);
    CHECK(outputs.ticks[ELEVATOR] == 6000 - ticks);
    CHECK(outputs.ticks[RUDDER] == ticks);
    CHECK(outputs.ticks[THROTTLE] == 2800);
  }
}

TEST_CASE("the throttle is what the authority says, in every mode") {
  for (Mode mode : {Mode::ACRO, Mode::RATE, Mode::FBW, Mode::SETPOINT, Mode::OUTPUT}) {
    Flight flight;
    flight.demand.mode = mode;
    flight.stick(THROTTLE, 1900);
    flight.ask(THROTTLE, 1800);
    flight.demand.throttle = us_to_ticks(1234);
    CHECK(flight.us(THROTTLE) == 1234);
  }
}

TEST_CASE("FBW: the surfaces go against bank, pitch and rotation") {
  Flight flight(only_p(1.0f, 2.0f));
  flight.attitude = attitude_of(1000, 0, 0, 0, 0, 0);
  // 10 degrees demand -20 deg/s, at 1.25 us a unit.
  CHECK(flight.us(AILERONS) == doctest::Approx(1475).epsilon(0.001));
  flight.attitude = attitude_of(0, -500, 0, 0, 0, 0);
  CHECK(flight.us(ELEVATOR) == doctest::Approx(1512.5).epsilon(0.001));
  flight.attitude = attitude_of(0, 0, 0, 40 * 16, -20 * 16, 0);
  CHECK(flight.us(AILERONS) == doctest::Approx(1450).epsilon(0.001));
  CHECK(flight.us(ELEVATOR) == doctest::Approx(1525).epsilon(0.001));
}

TEST_CASE("FBW: the sticks ask for bank and pitch up to the profile's limits") {
  Flight flight(only_p(1.0f, 1.0f));
  flight.stick(AILERONS, 2000);
  flight.stick(ELEVATOR, 2000);
  flight.attitude = attitude_of(5000, 2000, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500);
  CHECK(flight.us(ELEVATOR) == 1500);
  flight.stick(AILERONS, 1000);
  flight.stick(ELEVATOR, 1000);
  flight.attitude = attitude_of(-5000, -2500, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500);
  CHECK(flight.us(ELEVATOR) == 1500);
  flight.profile.roll_limit_cdeg = 3000;
  flight.profile.pitch_down_limit_cdeg = 1000;
  flight.attitude = attitude_of(-3000, -1000, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500);
  CHECK(flight.us(ELEVATOR) == 1500);
  // Half a stick is half the bank.
  flight.stick(AILERONS, 1750);
  flight.attitude = attitude_of(1500, -1000, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500);
}

TEST_CASE("an angle asks for no faster rotation than its limit") {
  Flight flight(only_p(1.0f, 50.0f));
  flight.attitude = attitude_of(-6000, 0, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500 + 120 * 1.25);
  flight.attitude = attitude_of(0, -4000, 0, 0, 0, 0);
  CHECK(flight.us(ELEVATOR) == 1500 + 80 * 1.25);
}

TEST_CASE("the way back from inverted flight is the shorter one") {
  Flight flight(only_p(1.0f, 1.0f));
  flight.stick(AILERONS, 2000);
  flight.attitude = attitude_of(-17000, 0, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) < 1500);
  flight.stick(AILERONS, 1000);
  flight.attitude = attitude_of(17000, 0, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) > 1500);
}

TEST_CASE("a banked aircraft holds its nose by pitching with the turn") {
  Flight flight(only_p(1.0f, 8.0f));
  for (int bank_deg : {-49, -20, 20, 49}) {
    CAPTURE(bank_deg);
    flight.stick(AILERONS, 1500 + bank_deg * 10);
    // A level turn: the yaw rate and the pitch rate that its bank has, 20 deg/s in all.
    const double bank = bank_deg * DEG;
    const double turn_16 = (bank_deg < 0 ? -20 : 20) * 16;
    const int pitch_rate = static_cast<int>(std::lround(turn_16 * std::sin(bank)));
    const int yaw_rate = static_cast<int>(std::lround(turn_16 * std::cos(bank)));
    flight.attitude = attitude_of(bank_deg * 100, 0, 0, 0, pitch_rate, yaw_rate);
    CHECK(flight.us(ELEVATOR) == doctest::Approx(1500).epsilon(0.001));
    flight.attitude = attitude_of(bank_deg * 100, 0, 0, 0, 0, yaw_rate);
    CHECK(flight.us(ELEVATOR) == doctest::Approx(1500 + pitch_rate / 16.0 * 1.25).epsilon(0.001));
  }
}

TEST_CASE("beyond 90 degrees of bank the aircraft rolls first and does not pull") {
  Flight flight(only_p(1.0f, 8.0f));
  for (int bank_deg : {-170, -120, -91, 91, 120, 170, 180}) {
    CAPTURE(bank_deg);
    flight.attitude = attitude_of(bank_deg * 100, -3000, 0, 0, 0, 200);
    CHECK(flight.us(ELEVATOR) == 1500);
    CHECK(std::fabs(flight.us(AILERONS) - 1500) == doctest::Approx(225 * 1.25).epsilon(0.002));
  }
  flight.attitude = attitude_of(8000, -3000, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500 - 120 * 1.25);
  CHECK(flight.us(ELEVATOR) == doctest::Approx(1500 + 80 * std::cos(80 * DEG) * 1.25).epsilon(0.001));
}

TEST_CASE("RATE: the stick is a rotation, and attitude does not matter") {
  Flight flight(only_p(2.0f, 9.0f));
  flight.demand.mode = Mode::RATE;
  flight.stick(AILERONS, 2000);
  flight.stick(ELEVATOR, 1250);
  flight.attitude = attitude_of(17000, 5000, 0, 180 * 16, -45 * 16, 0);
  CHECK(flight.us(AILERONS) == doctest::Approx(1500).epsilon(0.0005));
  CHECK(flight.us(ELEVATOR) == doctest::Approx(1500).epsilon(0.0005));
  flight.attitude = attitude_of(17000, 5000, 0, 160 * 16, -65 * 16, 0);
  CHECK(flight.us(AILERONS) == doctest::Approx(1550).epsilon(0.001));
  CHECK(flight.us(ELEVATOR) == doctest::Approx(1550).epsilon(0.001));
}

TEST_CASE("SETPOINT: the Raspberry Pi's attitude, within the limits of FBW") {
  Flight flight(only_p(1.0f, 1.0f));
  flight.demand.mode = Mode::SETPOINT;
  flight.stick(AILERONS, 2000);
  flight.demand.asked.setpoint = {-2000, 1000, 0, 0};
  flight.attitude = attitude_of(-2000, 1000, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500);
  CHECK(flight.us(ELEVATOR) == 1500);
  flight.demand.asked.setpoint = {32767, -32768, 0, 0};
  flight.attitude = attitude_of(5000, -2500, 0, 0, 0, 0);
  CHECK(flight.us(AILERONS) == 1500);
  CHECK(flight.us(ELEVATOR) == 1500);
  flight.demand.asked.setpoint = {0, 0, 1000, 0};
  flight.attitude = Attitude();
  CHECK(flight.us(RUDDER) == doctest::Approx(1512.5).epsilon(0.001));
}

TEST_CASE("OUTPUT: the Raspberry Pi's surfaces, through the servos' directions like sticks") {
  Flight flight;
  flight.demand.mode = Mode::OUTPUT;
  flight.ask(AILERONS, 1600);
  flight.ask(ELEVATOR, 1450);
  flight.ask(RUDDER, 1320);
  flight.attitude = attitude_of(3000, 2000, 0, 800, 800, 800);
  CHECK(flight.us(AILERONS) == 1600);
  CHECK(flight.us(ELEVATOR) == 1450);
  CHECK(flight.us(RUDDER) == 1320);
  // A demand that rolls right from the Arduino rolls right from the Raspberry Pi.
  flight.profile.servos[AILERONS].is_reversed = true;
  CHECK(flight.us(AILERONS) == 1400);
  flight.demand.mode = Mode::ACRO;
  flight.stick(AILERONS, 1600);
  CHECK(flight.us(AILERONS) == 1400);
}

TEST_CASE("the rudder is stick plus damper: a steady turn passes, swinging does not") {
  Flight flight(only_p(1.0f, 1.0f));
  flight.stick(RUDDER, 1600);
  flight.attitude = Attitude();
  CHECK(flight.us(RUDDER) == 1600);
  flight.attitude.yaw_rate_16 = 40 * 16;
  CHECK(flight.us(RUDDER) == doctest::Approx(1550).epsilon(0.001));
  flight.fly(5000);
  CHECK(flight.us(RUDDER) == doctest::Approx(1600).epsilon(0.001));
  flight.attitude.yaw_rate_16 = 0;
  CHECK(flight.us(RUDDER) == doctest::Approx(1650).epsilon(0.001));
}

TEST_CASE("no heading is held: yaw itself never moves the rudder") {
  Flight flight(only_p(3.0f, 9.0f));
  for (int yaw = -18000; yaw <= 18000; yaw += 500) {
    flight.attitude.yaw_cdeg = static_cast<int16_t>(yaw);
    CHECK(flight.us(RUDDER) == 1500);
  }
}

TEST_CASE("a lost receiver: the circle at the glide's pitch, sticks and modes forgotten") {
  for (Mode mode : {Mode::ACRO, Mode::RATE, Mode::FBW, Mode::SETPOINT, Mode::OUTPUT}) {
    Flight flight;
    flight.tune(only_p(1.0f, 1.0f));
    flight.demand.mode = mode;
    flight.demand.is_failsafe = true;
    flight.stick(AILERONS, 1000);
    flight.stick(RUDDER, 2000);
    flight.profile.preset_rudder_us = 1600;
    flight.ask(AILERONS, 2000);
    flight.attitude = attitude_of(2000, -300, 0, 0, 0, 0);
    CHECK(flight.us(AILERONS) == 1500);
    CHECK(flight.us(ELEVATOR) == 1500);
    CHECK(flight.us(RUDDER) == 1500);
    flight.attitude = attitude_of(0, 0, 0, 0, 0, 0);
    CHECK(flight.us(AILERONS) == 1525);
    CHECK(flight.us(ELEVATOR) == doctest::Approx(1496.25).epsilon(0.001));
  }
}

TEST_CASE("a lost receiver without an IMU: the preset surfaces") {
  Flight flight;
  flight.demand.is_failsafe = true;
  flight.demand.is_imu_valid = false;
  flight.profile.preset_ailerons_us = 1510;
  flight.profile.preset_elevator_us = 1460;
  flight.profile.preset_rudder_us = 1570;
  flight.stick(AILERONS, 1000);
  flight.attitude = attitude_of(3000, 3000, 0, 900, 900, 900);
  CHECK(flight.us(AILERONS) == 1510);
  CHECK(flight.us(ELEVATOR) == 1460);
  CHECK(flight.us(RUDDER) == 1570);
  CHECK(flight.us(THROTTLE) == 1400);
}

TEST_CASE("without an IMU every mode that needs it passes the sticks through") {
  for (Mode mode : {Mode::RATE, Mode::FBW, Mode::SETPOINT}) {
    Flight flight;
    flight.demand.mode = mode;
    flight.demand.is_imu_valid = false;
    flight.stick(AILERONS, 1650);
    flight.stick(ELEVATOR, 1234);
    flight.stick(RUDDER, 1777);
    flight.attitude = attitude_of(3000, 3000, 0, 900, 900, 900);
    CHECK(flight.us(AILERONS) == 1650);
    CHECK(flight.us(ELEVATOR) == 1234);
    CHECK(flight.us(RUDDER) == 1777);
  }
}

TEST_CASE("integrals of ACRO's time mean nothing: each entry begins from zero") {
  Flight flight;
  Gains gains = only_p(1.0f, 1.0f);
  gains.rate[0].i = 20;
  flight.tune(gains);
  flight.attitude.roll_rate_16 = -50 * 16;
  flight.fly(500);
  CHECK(flight.us(AILERONS) > 1900);
  flight.attitude = Attitude();
  CHECK(flight.us(AILERONS) > 1800);
  flight.demand.mode = Mode::ACRO;
  flight.attitude.roll_rate_16 = -50 * 16;
  flight.fly(500);
  flight.attitude = Attitude();
  flight.demand.mode = Mode::FBW;
  CHECK(flight.us(AILERONS) == 1500);
}

TEST_CASE("from FBW to SETPOINT, into the circle and back the surfaces do not jump") {
  Flight flight;
  Gains gains = only_p(1.0f, 1.0f);
  gains.rate[0].i = 20;
  gains.stabilize[0].i = 1;
  flight.tune(gains);
  flight.attitude.roll_cdeg = -100;
  flight.fly(300);
  flight.attitude = Attitude();
  const double before_us = flight.us(AILERONS);
  CHECK(before_us > 1505);
  flight.demand.mode = Mode::SETPOINT;
  CHECK(flight.us(AILERONS) == doctest::Approx(before_us).epsilon(0.001));
  flight.demand.mode = Mode::FBW;
  flight.profile.circle_bank_cdeg = 0;
  flight.demand.is_failsafe = true;
  CHECK(flight.us(AILERONS) == doctest::Approx(before_us).epsilon(0.001));
}

TEST_CASE("gains fly within five slots of their change") {
  Flight flight(only_p(1.0f, 1.0f));
  flight.attitude = attitude_of(0, 0, 0, -20 * 16, -20 * 16, 0);
  CHECK(flight.us(AILERONS) == 1525);
  flight.gains = only_p(2.0f, 1.0f);
  CHECK(flight.us(AILERONS) == 1525);
  flight.controller.on_gains();
  flight.fly(SLOTS_TO_TUNE);
  CHECK(flight.us(AILERONS) == 1550);
  CHECK(flight.us(ELEVATOR) == 1550);
}

TEST_CASE("no stick, attitude or gain lets a servo out of its end points") {
  std::mt19937 random(9);
  std::uniform_int_distribution<int> any(-32768, 32767);
  std::uniform_real_distribution<float> gain(0.0f, 50.0f);
  const Mode modes[] = {Mode::ACRO, Mode::RATE, Mode::FBW, Mode::SETPOINT, Mode::OUTPUT};
  Flight flight;
  for (int round = 0; round < 20000; ++round) {
    if (round % 20 == 0) {
      for (int axis = 0; axis < 3; ++axis) {
        flight.gains.rate[axis] = {gain(random), gain(random), gain(random)};
        flight.gains.stabilize[axis] = {gain(random), gain(random), gain(random)};
      }
      flight.controller.on_gains();
    }
    const auto number = [&] { return static_cast<int16_t>(any(random)); };
    flight.demand.mode = modes[random() % 5];
    flight.demand.is_failsafe = random() % 4 == 0;
    flight.demand.is_imu_valid = random() % 4 != 0;
    for (Ticks& stick : flight.demand.sticks) stick = number();
    for (Ticks& asked : flight.demand.asked.outputs.ticks) asked = number();
    flight.demand.throttle = number();
    flight.demand.asked.setpoint = {number(), number(), number(), 0};
    flight.attitude = attitude_of(static_cast<int16_t>(any(random) % 18001),
                       static_cast<int16_t>(any(random) % 9001),
                       static_cast<int16_t>(any(random) % 18001),
                       number(), number(), number());
    const Outputs& outputs = flight.controller.update(flight.demand, flight.attitude);
    for (Ticks output : outputs.ticks) {
      CHECK(output >= 2000);
      CHECK(output <= 4000);
    }
  }
}

TEST_CASE("RETURN: the set-point within FBW's limits, the rudder without its stick") {
  Flight flight(only_p(1.0f, 2.0f));
  flight.demand.mode = Mode::RETURN;
  flight.demand.is_failsafe = true;
  flight.stick(RUDDER, 1900);
  flight.profile.preset_rudder_us = 1300;
  flight.demand.asked.setpoint = Setpoint{1000, 500, 0, 0};
  CHECK(flight.us(AILERONS) == doctest::Approx(1525).epsilon(0.001));
  CHECK(flight.us(ELEVATOR) == doctest::Approx(1512.5).epsilon(0.001));
  CHECK(flight.us(RUDDER) == 1500);
  flight.demand.asked.setpoint = Setpoint{18000, -9000, 0, 0};
  const double steepest = flight.us(AILERONS);
  const double lowest = flight.us(ELEVATOR);
  flight.demand.asked.setpoint = Setpoint{flight.profile.roll_limit_cdeg,
                                    negative(flight.profile.pitch_down_limit_cdeg), 0, 0};
  CHECK(flight.us(AILERONS) == steepest);
  CHECK(flight.us(ELEVATOR) == lowest);
}

TEST_CASE("the slew limit slows a motor's rise to 5 %/s a step and never its fall") {
  for (uint8_t steps : {uint8_t{1}, uint8_t{20}}) {
    Flight flight;
    flight.demand.mode = Mode::FBW;
    flight.profile.flags = static_cast<uint8_t>(steps * SLEW_UNIT);
    flight.demand.throttle = us_to_ticks(2000);
    flight.fly(250);
    // Half a second at 5 % of 1000 us a second and step.
    CHECK(flight.us(THROTTLE) == doctest::Approx(1000 + 25 * steps).epsilon(0.001));
    flight.demand.throttle = us_to_ticks(1000);
    CHECK(flight.us(THROTTLE) == 1000);
  }
}

TEST_CASE("the slew limit is off by default, and no glider's brake has one") {
  Flight flight;
  flight.demand.throttle = us_to_ticks(2000);
  CHECK(flight.us(THROTTLE) == 2000);
  flight.profile.flags = SLEW_UNIT;
  flight.profile.has_motor = false;
  flight.demand.throttle = us_to_ticks(1000);
  flight.fly(2);
  flight.demand.throttle = us_to_ticks(2000);
  CHECK(flight.us(THROTTLE) == 2000);
}
