#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "control/pid.h"

using namespace raspilot;

namespace {

constexpr int SLOTS = 400;
constexpr int EVERY = 8;
constexpr int32_t RATE_LIMIT = 400 << 14;

struct PidVector {
  double p, i, d;
  double limit;
  int bits;
  double wanted;
  double amplitude;
  double period_s;
  double answers[SLOTS / EVERY];
};

const PidVector VECTORS_OF_SIMPLE_PID[] = {
#include "pid_vectors.inc"
};

int16_t to_fixed(double value, int bits) {
  return static_cast<int16_t>(std::lround(std::ldexp(value, bits)));
}

/** The measurement of a slot, rounded as pid_vectors.py rounds it. */
double moved(const PidVector& vector, int slot) {
  const double sine = std::sin(2 * 3.14159265358979323846 * slot * 0.002 / vector.period_s);
  return std::ldexp(std::nearbyint(std::ldexp(vector.amplitude * sine, vector.bits)), -vector.bits);
}

PidGains gains_of(double p, double i, double d) {
  return {static_cast<float>(p), static_cast<float>(i), static_cast<float>(d)};
}

int32_t limit_of(double limit, int bits) {
  return static_cast<int32_t>(std::ldexp(limit, bits + 10));
}

}  // namespace

TEST_CASE("a PID answers what simple-pid answers") {
  for (const PidVector& vector : VECTORS_OF_SIMPLE_PID) {
    CAPTURE(vector.p);
    CAPTURE(vector.i);
    CAPTURE(vector.d);
    const int32_t limit = limit_of(vector.limit, vector.bits);
    Pid pid = Pid();
    pid.tune(gains_of(vector.p, vector.i, vector.d));
    double greatest = 0;
    for (int slot = 0; slot < SLOTS; ++slot) {
      const double measured = moved(vector, slot);
      const int32_t answer = pid.update(to_fixed(vector.wanted - measured, vector.bits),
                                        to_fixed(measured, vector.bits), limit);
      if (slot % EVERY != EVERY - 1) continue;
      const double expected = vector.answers[slot / EVERY];
      const double error = std::ldexp(answer, -vector.bits - 10) - expected;
      greatest = std::fmax(greatest, std::fabs(error));
    }
    // A two-hundredth of the limit; the low-pass of D lags by 7 ms, and its start shows.
    CHECK(greatest <= vector.limit * (vector.d > 0 ? 0.04 : 0.002));
  }
}

TEST_CASE("no input leaves the limits or 32 bits") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> gain(0.0f, 50.0f);
  std::uniform_int_distribution<int> input(-32767, 32767);
  for (int round = 0; round < 300; ++round) {
    const int32_t limit = round % 2 ? 400 << 14 : 225 << 17;
    Pid pid = Pid();
    for (int slot = 0; slot < 200; ++slot) {
      if (slot % 50 == 0) pid.tune({gain(random), gain(random), gain(random)});
      const int16_t error = static_cast<int16_t>(input(random));
      const int32_t answer = pid.update(error, static_cast<int16_t>(input(random)), limit);
      CHECK(std::abs(answer) <= limit);
    }
  }
}

TEST_CASE("the integral does not grow while the output stands at its limit") {
  Pid pid = Pid();
  pid.tune({4.0f, 5.0f, 0.0f});
  for (int slot = 0; slot < 5000; ++slot) CHECK(pid.update(150 * 16, 0, RATE_LIMIT) == RATE_LIMIT);
  // The error turns: the output leaves the limit in the first slot.
  CHECK(pid.update(-1, 0, RATE_LIMIT) < RATE_LIMIT / 100);
}

TEST_CASE("the integral stops at the limit and comes back from there") {
  Pid pid = Pid();
  pid.tune({0.0f, 50.0f, 0.0f});
  for (int slot = 0; slot < 50000; ++slot) pid.update(32767, 0, RATE_LIMIT);
  int slots = 0;
  // 50 units a second and deg/s: 400 of them at 100 deg/s take 80 ms.
  while (pid.update(-1600, 0, RATE_LIMIT) > 0) ++slots;
  CHECK(slots >= 38);
  CHECK(slots <= 41);
}

TEST_CASE("gains change without a jump of what the integral gives") {
  Pid pid = Pid();
  pid.tune({0.0f, 10.0f, 0.0f});
  int32_t before = 0;
  for (int slot = 0; slot < 500; ++slot) before = pid.update(10 * 16, 0, RATE_LIMIT);
  pid.tune({0.0f, 2.0f, 0.0f});
  CHECK(std::abs(pid.update(0, 0, RATE_LIMIT) - before) <= 1 << 10);
  pid.tune({3.0f, 0.0f, 0.0f});
  CHECK(pid.update(0, 0, RATE_LIMIT) == 0);
}

TEST_CASE("the derivative is on the measurement: a new aim does not kick") {
  Pid pid = Pid();
  pid.tune({0.0f, 0.0f, 0.5f});
  pid.update(0, 160, RATE_LIMIT);
  CHECK(pid.update(3000, 160, RATE_LIMIT) == 0);
  CHECK(pid.update(-3000, 160, RATE_LIMIT) == 0);
  CHECK(pid.update(0, 176, RATE_LIMIT) < 0);
}

TEST_CASE("a measurement that wraps around the circle does not count as a change") {
  Pid pid = Pid();
  pid.tune({0.0f, 0.0f, 1.0f});
  pid.update(0, 23000, RATE_LIMIT);
  CHECK(pid.update(0, -23000, RATE_LIMIT) == 0);
}

TEST_CASE("after a reset nothing of the past is left") {
  Pid fresh = Pid();
  Pid used = Pid();
  fresh.tune({2.0f, 3.0f, 0.1f});
  used.tune({2.0f, 3.0f, 0.1f});
  for (int16_t slot = 0; slot < 100; ++slot) used.update(1234, slot, RATE_LIMIT);
  used.reset();
  for (int slot = 0; slot < 100; ++slot) {
    const int16_t measured = static_cast<int16_t>(slot * 3);
    CHECK(used.update(500, measured, RATE_LIMIT) == fresh.update(500, measured, RATE_LIMIT));
  }
}
