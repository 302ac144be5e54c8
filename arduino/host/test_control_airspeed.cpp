#include <doctest/doctest.h>

#include <functional>

#include "attitude_flight.h"
#include "link_bench.h"

using namespace raspilot;

namespace {

constexpr double SPEED_M_S = 13;
constexpr int SLOTS_A_MESSAGE = 100;

/** An airspeed at a time, m/s: the one flown, or the one in `A` (0: none is sent). */
typedef std::function<double(double)> Airspeed;

double steady(double) { return SPEED_M_S; }
double nothing(double) { return 0; }
/** From 13 to 22 m/s and back. */
double faster(double time_s) {
  return SPEED_M_S + 0.75 * std::fmax(0, std::fmin(12, std::fmin(time_s - 60, 90 - time_s)));
}
Airspeed wrong_by(double error_m_s) {
  return [error_m_s](double time_s) {
    return SPEED_M_S + (time_s >= 30 && time_s < 90 ? error_m_s : 0);
  };
}

/** The greatest tilt error in a turn at this bank; `pitch_up_deg_s` begins a climb for 2 s. */
double error_deg(double bank_deg, double seconds, const Airspeed& flown, const Airspeed& sent,
                 double pitch_up_deg_s = 0) {
  Flight flight(4);
  roll_to(flight, bank_deg);
  double greatest = 0;
  for (int slot = 0; slot < seconds * 500; ++slot) {
    const double time_s = slot * 0.002;
    const double speed = flown(time_s);
    if (slot % SLOTS_A_MESSAGE == 0 && sent(time_s) != 0) {
      flight.filter.take_airspeed(static_cast<int16_t>(sent(time_s) * 100));
    }
    const bool begins_climb = time_s >= seconds - 4 && time_s < seconds - 2;
    const double up_deg_s = begins_climb ? pitch_up_deg_s : 0;
    const double bank = flight.imu.roll_deg() * DEG;
    const double rate_deg_s = GRAVITY_M_S2 * std::tan(bank) / speed / DEG;
    const double along = (flown(time_s + 0.002) - speed) / 0.002 / GRAVITY_M_S2;
    const double pull = speed * up_deg_s * DEG / GRAVITY_M_S2;
    // The path rises with the nose: its force is up, gravity along the nose.
    const double* const down = flight.imu.down;
    const double force[3] = {along - down[0], -pull * std::sin(bank),
                             -1 / std::cos(bank) - pull * std::cos(bank)};
    flight.slot_with_force(0, rate_deg_s * std::sin(bank) + up_deg_s * std::cos(bank),
                           rate_deg_s * std::cos(bank) - up_deg_s * std::sin(bank), force);
    greatest = std::fmax(greatest, flight.tilt_error_deg());
  }
  return greatest;
}

/** What the filter knows after half a minute with this `A` five times a second; none if empty. */
std::vector<int32_t> known_after(const Bytes& payload) {
  LinkBench bench;
  MovingImu imu;
  for (int slot = 0; slot < 15000; ++slot) {
    if (!payload.empty() && slot % SLOTS_A_MESSAGE == 0) bench.send('A', payload);
    imu.turn(slot % 2000 < 1000 ? 10 : -10, 1, 5);
    const ImuSample sample = imu.sample();
    bench.autopilot.control(&sample, bench.now_us);
    bench.run_ms(2);
  }
  const AttitudeState state = bench.autopilot.attitude.state();
  std::vector<int32_t> known(state.gravity_q30, state.gravity_q30 + 3);
  known.insert(known.end(), state.bias_q36, state.bias_q36 + 3);
  known.push_back(static_cast<int32_t>(state.speed_m_s * 1e6));
  return known;
}

}  // namespace

TEST_CASE("with a measured airspeed an acceleration along the nose is no pitch angle") {
  CHECK(error_deg(0, 100, faster, nothing) > 3.0);
  CHECK(error_deg(0, 100, faster, faster) <= 0.2);
  CHECK(error_deg(15, 100, faster, nothing) > 2.0);
  CHECK(error_deg(15, 100, faster, faster) <= 0.2);
}

TEST_CASE("with a measured airspeed a climb that begins in a turn is no bank") {
  CHECK(error_deg(20, 60, steady, nothing, 5) > 0.6);
  CHECK(error_deg(20, 60, steady, steady, 5) <= 0.2);
}

TEST_CASE("an airspeed that is wrong by 5 m/s for a minute tilts the attitude by 6 degrees at most") {
  for (double bank_deg : {0.0, 15.0, 30.0}) {
    for (double error_m_s : {-5.0, 5.0}) {
      CAPTURE(bank_deg);
      CHECK(error_deg(bank_deg, 120, steady, wrong_by(error_m_s)) <= 6.0);
    }
    CHECK(error_deg(bank_deg, 120, steady, wrong_by(20)) <= 0.2);
  }
}

TEST_CASE("an airspeed counts for one cycle") {
  const Airspeed wrong_once = [](double time_s) {
    return time_s >= 30 && time_s < 30.1 ? SPEED_M_S + 5 : 0;
  };
  CHECK(error_deg(15, 90, steady, wrong_once) <= 0.5);
}

TEST_CASE("an airspeed out of range is refused and leaves the attitude as without one") {
  const std::vector<int32_t> expected = known_after({});
  CHECK(known_after({0x01, 0xf3}) == expected);  // 4.99 m/s
  CHECK(known_after({0x0f, 0xa1}) == expected);  // 40.01 m/s
  CHECK(known_after({0, 0}) == expected);
  CHECK(known_after({0xff, 0xff}) == expected);
  CHECK(known_after({0x05, 0x14}) != expected);
}
