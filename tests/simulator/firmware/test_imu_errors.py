"""Noise, bias, drift and vibration have their configured values, and repeat for a seed."""

import itertools
import math
import statistics

import pytest

from up_rig.imu import Motion
from up_simulator.firmware.imu_errors import BoardImu, ImuErrors, drawn_errors

STILL = Motion()
QUIET = {"gyro_noise_deg_s": 0.0, "accel_noise_m_s2": 0.0}
SAMPLE_S = 0.0005


def samples(errors, *, seed=1, seconds=2.0, throttle=0.0):
    model = BoardImu(errors, seed)
    model.throttle = throttle
    return [model.measure(at * SAMPLE_S) for at in range(round(seconds / SAMPLE_S))]


def rolls(measured):
    return [each.roll_rate_deg_s for each in measured]


def test_without_errors_it_measures_the_truth():
    assert set(samples(ImuErrors(**QUIET), seconds=0.01)) == {STILL}


def test_noise_has_the_deviation_that_was_set():
    measured = samples(ImuErrors(gyro_noise_deg_s=0.2, accel_noise_m_s2=0.5))
    assert statistics.stdev(rolls(measured)) == pytest.approx(0.2, rel=0.05)
    assert statistics.stdev([each.force_z_m_s2 for each in measured]) == pytest.approx(
        0.5, rel=0.05
    )
    assert statistics.mean(rolls(measured)) == pytest.approx(0, abs=0.02)


def test_each_axis_has_its_own_bias():
    errors = ImuErrors(**QUIET, gyro_bias_deg_s=(1, -2, 3), accel_bias_m_s2=(0.1, -0.2, 0.3))
    assert samples(errors, seconds=0.001)[-1] == Motion(1, -2, 3, 0.1, -0.2, -9.80665 + 0.3)


def test_the_gyro_drifts_until_it_is_warm():
    model = BoardImu(ImuErrors(**QUIET, gyro_drift_deg_s=(2, 0, -4), warm_up_s=30), seed=1)
    assert model.measure(0.0).roll_rate_deg_s == 0
    warming = model.measure(30.0)
    assert warming.roll_rate_deg_s == pytest.approx(2 * (1 - 1 / math.e))
    assert model.measure(600.0).yaw_rate_deg_s == pytest.approx(-4, abs=1e-6)


@pytest.mark.parametrize(("throttle", "amplitude", "hz"), [(1.0, 4.0, 100.0), (0.5, 1.0, 50.0)])
def test_the_vibration_goes_with_the_throttle(throttle, amplitude, hz):
    errors = ImuErrors(**QUIET, vibration_m_s2=4.0, vibration_hz=100.0)
    forces = [each.force_x_m_s2 for each in samples(errors, throttle=throttle, seconds=1.0)]
    assert max(forces) == pytest.approx(amplitude, rel=0.02)
    assert min(forces) == pytest.approx(-amplitude, rel=0.02)
    rises = sum(before < 0 <= after for before, after in itertools.pairwise(forces))
    assert rises == pytest.approx(hz, abs=1)


def test_nothing_shakes_while_the_motor_stands():
    errors = ImuErrors(**QUIET, vibration_m_s2=4.0, vibration_deg_s=3.0)
    assert set(samples(errors, seconds=0.01)) == {STILL}


def test_errors_change_in_flight():
    model = BoardImu(ImuErrors(**QUIET), seed=1)
    assert model.measure(1.0) == STILL
    model.errors = ImuErrors(**QUIET, gyro_bias_deg_s=(5, 0, 0))
    assert model.measure(1.001).roll_rate_deg_s == 5


def test_the_same_seed_errs_alike():
    errors = ImuErrors(vibration_m_s2=1.0)
    assert samples(errors, seed=3, seconds=0.1) == samples(errors, seed=3, seconds=0.1)
    assert rolls(samples(errors, seed=3, seconds=0.1)) != rolls(
        samples(errors, seed=4, seconds=0.1)
    )


def test_each_seed_draws_the_bias_and_the_drift_of_another_sensor():
    drawn = [drawn_errors(seed) for seed in range(50)]
    assert drawn == [drawn_errors(seed) for seed in range(50)]
    for axis in range(3):
        biases = [each.gyro_bias_deg_s[axis] for each in drawn]
        assert all(2 <= abs(each) <= 4 for each in biases)
        assert min(biases) < -3.5 and max(biases) > 3.5
        drifts = [each.gyro_drift_deg_s[axis] for each in drawn]
        assert -1 <= min(drifts) < -0.8 and 0.8 < max(drifts) <= 1


def test_given_errors_of_a_sensor_are_not_drawn():
    known = drawn_errors(3, gyro_bias_deg_s=(0.0, 1.0, 0.0), vibration_hz=99.0)
    assert (known.gyro_bias_deg_s, known.vibration_hz) == ((0.0, 1.0, 0.0), 99.0)
    assert known.gyro_drift_deg_s == drawn_errors(3).gyro_drift_deg_s
