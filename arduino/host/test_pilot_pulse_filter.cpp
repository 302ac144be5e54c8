#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "pilot/pulse_filter.h"

using namespace raspilot;

namespace {

/** A pulse between two stamps that are each up to half a microsecond off, as Timer1 sees it. */
Ticks stamped(double width_us, std::mt19937& random) {
  std::uniform_real_distribution<double> noise_us(-0.5, 0.5);
  const double begin = std::floor(2 * (1000.25 + noise_us(random)));
  const double end = std::floor(2 * (1000.25 + width_us + noise_us(random)));
  return static_cast<Ticks>(end - begin);
}

struct Spread {
  double mean_us;
  double deviation_us;
};

Spread spread_at(double width_us, uint32_t seed) {
  std::mt19937 random(seed);
  PulseFilter filter;
  for (int i = 0; i < 50; ++i) filter.update(stamped(width_us, random), false);
  double sum = 0, squares = 0;
  const int count = 2000;
  for (int i = 0; i < count; ++i) {
    filter.update(stamped(width_us, random), false);
    const double us = filter.pulse() / 2.0;
    sum += us;
    squares += us * us;
  }
  const double mean = sum / count;
  return Spread{mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

/** The rms of output minus stick, us, over a movement. */
template <class Stick>
double error_rms_us(Stick stick_us, uint32_t seed) {
  std::mt19937 random(seed);
  PulseFilter filter;
  for (int i = 0; i < 20; ++i) filter.update(stamped(stick_us(0), random), false);
  double squares = 0;
  const int count = 2000;
  for (int i = 0; i < count; ++i) {
    filter.update(stamped(stick_us(i), random), false);
    const double error_us = filter.pulse() / 2.0 - stick_us(i);
    squares += error_us * error_us;
  }
  return std::sqrt(squares / count);
}

}  // namespace

TEST_CASE("pilot filter: a still stick gives a still output at half a microsecond of noise") {
  for (uint32_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const double width_us = 1000 + 25.13 * seed;
    const Spread spread = spread_at(width_us, seed);
    CHECK(spread.deviation_us <= 0.3);
    CHECK(std::fabs(spread.mean_us - width_us) <= 0.25);
  }
}

TEST_CASE("pilot filter: pulses of one width are passed on exactly") {
  for (int width = us_to_ticks(885); width <= us_to_ticks(2115); width += 7) {
    PulseFilter filter;
    for (int i = 0; i < 12; ++i) filter.update(static_cast<Ticks>(width), false);
    CHECK(std::abs(filter.pulse() - width) <= 1);
  }
}

TEST_CASE("pilot filter: it has no bias between rising and falling") {
  // Both ways to the same width, in steps that the bypass does not see.
  for (int step : {2, 5, 9, 17, 30, 38}) {
    PulseFilter up, down;
    up.reset(3000);
    down.reset(3000);
    up.update(static_cast<Ticks>(3000 + step), false);
    down.update(static_cast<Ticks>(3000 - step), false);
    CHECK(up.pulse() - 3000 == 3000 - down.pulse());
  }
}

TEST_CASE("pilot filter: a moving stick passes within a microsecond rms") {
  for (uint32_t seed = 0; seed < 10; ++seed) {
    for (double step_us : {0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 19.0, 40.0}) {
      CAPTURE(step_us);
      const auto there_and_back = [step_us](int i) {
        const double way_us = std::fmod(step_us * i, 1600.0);
        return 1100.0 + (way_us < 800 ? way_us : 1600 - way_us);
      };
      CHECK(error_rms_us(there_and_back, seed) <= 1.0);
    }
    const auto slow_wave = [](int i) { return 1500 + 400 * std::sin(i * 0.02); };
    CHECK(error_rms_us(slow_wave, seed) <= 1.0);
    const auto fast_wave = [](int i) { return 1500 + 400 * std::sin(i * 0.2); };
    CHECK(error_rms_us(fast_wave, seed) <= 1.0);
  }
}

TEST_CASE("pilot filter: a change of 20 us or more passes immediately, a smaller one by half") {
  PulseFilter filter;
  filter.update(us_to_ticks(1500 + 20), false);
  CHECK(filter.pulse() == us_to_ticks(1520));
  filter.update(us_to_ticks(1500), false);
  CHECK(filter.pulse() == us_to_ticks(1500));
  filter.reset(us_to_ticks(1500));
  filter.update(us_to_ticks(1500 + 16), false);
  CHECK(filter.pulse() == us_to_ticks(1508));
}

TEST_CASE("pilot filter: a change that continues, or reverses by 3 us, passes immediately") {
  PulseFilter filter;
  filter.update(us_to_ticks(1510), false);
  filter.update(us_to_ticks(1518), false);
  CHECK(filter.pulse() == us_to_ticks(1518));
  filter.update(us_to_ticks(1510), false);
  CHECK(filter.pulse() == us_to_ticks(1510));
  filter.update(us_to_ticks(1512), false);
  CHECK(filter.pulse() < us_to_ticks(1512));
}

TEST_CASE("pilot filter: an uncertain stamp holds the value when it differs by 6 us at most") {
  PulseFilter filter;
  filter.reset(us_to_ticks(1500));
  for (int off_us : {-6, 3, 6, -1, 6, 6, 6}) {
    filter.update(static_cast<Ticks>(3000 + 2 * off_us), true);
    CHECK(filter.pulse() == us_to_ticks(1500));
  }
  filter.update(us_to_ticks(1526), true);
  CHECK(filter.pulse() == us_to_ticks(1526));
}
