#include <doctest/doctest.h>

#include <cmath>

#include "control/attitude_filter.h"
#include "control/flight_controller.h"
#include "moving_imu.h"

using namespace raspilot;

namespace {

/** A small glider: surfaces cause rotations with a lag; servos follow each 20 ms. */
class Glider {
 public:
  Profile profile = DEFAULT_PROFILE;
  Demand demand{};
  MovingImu imu;

  explicit Glider(const Gains& gains = DEFAULT_GAINS) : gains_(gains) {
    demand.mode = Mode::FBW;
    demand.is_imu_valid = true;
    for (Ticks& stick : demand.sticks) stick = us_to_ticks(1500);
    demand.throttle = us_to_ticks(1000);
    // Its gyro was calibrated.
    calibration_.gyro_bias_16[0] = 1;
  }

  void fly(double seconds) {
    for (int slots = static_cast<int>(seconds * 500); slots > 0; --slots) slot();
  }

  double roll_deg() const { return imu.roll_deg(); }
  double pitch_deg() const { return imu.pitch_deg(); }
  const AttitudeFilter& filter() const { return filter_; }

 private:
  static constexpr double FASTEST_DEG_S[3] = {250, 120, 60};
  static constexpr double LAG_SLOTS[3] = {40, 60, 100};
  static constexpr double SPEED_M_S = 12;

  void slot() {
    for (int axis = 0; axis < 3; ++axis) {
      const double asked = servos_[axis] / 1000.0 * FASTEST_DEG_S[axis];
      rate_deg_s_[axis] += (asked - rate_deg_s_[axis]) / LAG_SLOTS[axis];
    }
    imu.turn(rate_deg_s_[0], rate_deg_s_[1], rate_deg_s_[2]);
    // In the air a turn is felt: by the speed, across the nose.
    const double per_deg_s = SPEED_M_S * DEG / GRAVITY_M_S2;
    const double force[3] = {-imu.down[0], -imu.down[1] + rate_deg_s_[2] * per_deg_s,
                             -imu.down[2] - rate_deg_s_[1] * per_deg_s};
    filter_.on_sample(imu.sample(force));
    demand.is_imu_valid = filter_.is_valid();
    const Outputs& outputs = controller_.update(demand, filter_.attitude());
    if (++slots_ % 10 != 0) return;
    servos_[0] = outputs.ticks[AILERONS] - 3000;
    servos_[1] = outputs.ticks[ELEVATOR] - 3000;
    servos_[2] = outputs.ticks[RUDDER] - 3000;
  }

  Calibration calibration_ = DEFAULT_CALIBRATION;
  AttitudeFilter filter_{calibration_};
  Gains gains_;
  FlightController controller_{profile, gains_};
  double rate_deg_s_[3] = {0, 0, 0};
  int servos_[3] = {0, 0, 0};
  int slots_ = 0;
};

constexpr double Glider::FASTEST_DEG_S[3];
constexpr double Glider::LAG_SLOTS[3];

/** Roll rate in RATE at a demand of 36 deg/s, after a second. */
double rate_at_a_fifth_of_the_stick(const Gains& gains) {
  Glider glider(gains);
  glider.fly(2);
  glider.demand.mode = Mode::RATE;
  glider.demand.sticks[AILERONS] = us_to_ticks(1600);
  glider.fly(1);
  return glider.filter().attitude().roll_rate_16 / 16.0;
}

}  // namespace

TEST_CASE("with the default gains FBW levels a glider out of a steep bank in three seconds") {
  Glider glider;
  glider.imu.set(70, -40);
  glider.fly(3);
  for (int second = 0; second < 20; ++second) {
    glider.fly(1);
    CHECK(std::fabs(glider.roll_deg()) <= 3);
    CHECK(std::fabs(glider.pitch_deg()) <= 4);
  }
}

TEST_CASE("with the default gains FBW holds the bank that the stick asks for") {
  Glider glider;
  glider.fly(2);
  glider.demand.sticks[AILERONS] = us_to_ticks(1800);
  glider.demand.sticks[ELEVATOR] = us_to_ticks(1400);
  glider.fly(3);
  CHECK(glider.roll_deg() == doctest::Approx(30).epsilon(0.1));
  CHECK(glider.pitch_deg() == doctest::Approx(-5).epsilon(0.4));
}

TEST_CASE("with the default gains the failsafe flies the circle and the glide") {
  Glider glider;
  glider.fly(2);
  glider.demand.sticks[AILERONS] = us_to_ticks(1000);
  glider.demand.is_failsafe = true;
  glider.fly(4);
  CHECK(glider.roll_deg() == doctest::Approx(20).epsilon(0.15));
  CHECK(glider.pitch_deg() == doctest::Approx(-3).epsilon(0.7));
}

TEST_CASE("RATE turns as fast as the stick says, less what a rate loop without I leaves") {
  Gains gains = DEFAULT_GAINS;
  CHECK(rate_at_a_fifth_of_the_stick(gains) == doctest::Approx(20).epsilon(0.05));
  gains.rate[0].i = 10;
  CHECK(rate_at_a_fifth_of_the_stick(gains) == doctest::Approx(36).epsilon(0.05));
}
