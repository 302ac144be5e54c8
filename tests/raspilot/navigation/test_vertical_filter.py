"""The altitude with a barometer: whose error it has, and what moves it."""

import math

import pytest

from raspilot.navigation.vertical_filter import CLIMB_TAU_S, OFF_M, VerticalFilter

PRESSURE_M = 45.0
"""The barometer's altitude less the true one."""
WEATHER_M_S = 10.0 / 3600.0


class Level:
    """An aircraft at a constant altitude, with ten pressures and one fix each second.

    ``fix_m`` and ``pressure_m`` are the errors of the receiver and of the barometer; None: silent.
    """

    def __init__(self, true_m=300.0, *, fix_m=6.0, is_held=True):
        self.filter = VerticalFilter()
        self.filter.hold(is_held)
        self.true_m, self.time_s = true_m, 0.0
        self.fly(1, fix_m)

    def fly(self, duration_s, fix_m, pressure_m=PRESSURE_M, source="phone"):
        for turn in range(1, round(10 * duration_s) + 1):
            self.time_s = round(self.time_s + 0.1, 1)
            if pressure_m is not None:
                measured_m = self.true_m + pressure_m
                self.filter.fuse_barometer(self.time_s, 0.0, measured_m, source)
            if turn % 10 == 0 and fix_m is not None:
                self.filter.fuse_fix(self.time_s - 0.5, 0.0, self.true_m + fix_m)
        return self

    @property
    def error_m(self):
        return self.filter.altitude_at(self.time_s, 0.0) - self.true_m


def test_held_it_keeps_the_error_of_the_receiver_at_that_time():
    level = Level(fix_m=6.0)
    assert level.error_m == pytest.approx(6.0, abs=0.2)
    for minutes in range(1, 31):
        level.fly(60, 0.0)
        assert abs(level.error_m - 6.0) < 60 * minutes * WEATHER_M_S + 0.2
    assert level.filter.state_at(level.time_s, 0.0)[2] < 2.0


def test_not_held_it_follows_the_mean_of_the_fixes():
    level = Level(fix_m=6.0, is_held=False).fly(180, 0.0)
    assert abs(level.error_m) < 2.0
    held = level.error_m
    level.filter.hold(True)
    assert level.fly(120, -5.0).error_m == pytest.approx(held, abs=0.5)
    level.filter.hold(False)
    assert level.fly(180, -5.0).error_m == pytest.approx(-5.0, abs=2.0)


def test_held_it_follows_the_weather_in_an_hour():
    level = Level(fix_m=0.0)
    for minutes in range(1, 121):
        level.fly(60, 0.0, PRESSURE_M + 60 * minutes * WEATHER_M_S)
    assert 0.0 < level.error_m < 7.0


@pytest.mark.parametrize("other_m", [-80.0, PRESSURE_M + 4.0])
def test_an_offset_belongs_to_its_barometer(other_m):
    level = Level(fix_m=6.0).fly(60, 0.0)
    level.fly(10, 0.0, other_m, "sensor")
    assert level.error_m == pytest.approx(6.0, abs=0.5)
    assert level.filter.held_offset_m == pytest.approx(other_m - 6.0, abs=0.5)
    assert level.fly(10, 0.0).error_m == pytest.approx(6.0, abs=0.7)


@pytest.mark.parametrize("jump_m", [-40.0, 8.0, 300.0])
def test_a_barometer_that_jumps_has_another_offset(jump_m):
    level = Level(fix_m=6.0).fly(60, 0.0)
    level.fly(0.2, None, PRESSURE_M + jump_m)
    assert level.error_m == pytest.approx(6.0, abs=0.3)
    level.fly(60, 0.0, PRESSURE_M + jump_m)
    assert level.error_m == pytest.approx(6.0, abs=0.5)
    assert level.filter.jumps == 1
    assert level.fly(1, None).error_m == pytest.approx(6.0, abs=0.5), "and back"


def test_a_climb_as_fast_as_an_aircraft_climbs_is_no_jump():
    level = Level(fix_m=6.0).fly(60, 0.0)
    for _ in range(100):
        level.true_m += 1.0
        level.fly(0.1, None)
    assert level.filter.jumps == 0
    assert level.fly(2, None).error_m == pytest.approx(6.0, abs=3.0)


@pytest.mark.parametrize("lost_s", [3.0, 8.0, 90.0])
def test_without_the_barometer_the_fixes_continue_with_the_same_error(lost_s):
    level = Level(fix_m=6.0).fly(120, 0.0)
    level.fly(lost_s, 0.0, None)
    assert level.error_m == pytest.approx(6.0, abs=2.5)
    assert level.fly(1, 0.0).error_m == pytest.approx(6.0, abs=0.7)


def test_a_barometer_that_leaves_the_fixes_is_not_believed():
    level = Level(fix_m=0.0).fly(60, 0.0)
    for second in range(240):
        level.fly(1, 0.0, PRESSURE_M + second)
        assert abs(level.error_m) < 2.5 * OFF_M
    assert level.filter.jumps > 3


@pytest.mark.parametrize("lost_s", [4.0, 12.0, 60.0])
def test_a_single_fix_after_a_loss_does_not_move_a_held_altitude(lost_s):
    level = Level(fix_m=6.0).fly(60, 6.0).fly(lost_s, None)
    assert level.fly(1, 46.0).error_m == pytest.approx(6.0, abs=1.0)
    assert level.filter.jumps == 0
    assert level.fly(30, 46.0).error_m == pytest.approx(46.0, abs=OFF_M), "many of them do"


def test_high_up_the_first_fix_is_believed_although_the_barometer_was_there_before():
    level = Level(3900.0, fix_m=None)
    assert level.fly(1, 2.0).error_m == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize("before", ["nothing", "fix", "pressure", "both"])
def test_another_run_of_the_program_continues_with_the_offset(before):
    level = Level(fix_m=6.0).fly(60, 0.0)
    offset_m = level.filter.held_offset_m
    level.filter = VerticalFilter()
    fix_m = -4.0 if before in ("fix", "both") else None
    level.fly(1, fix_m, PRESSURE_M if before in ("pressure", "both") else None)
    level.filter.resume("phone", offset_m)
    assert level.fly(2, -4.0).error_m == pytest.approx(6.0, abs=0.5)
    assert level.fly(120, -4.0).error_m == pytest.approx(6.0, abs=0.5)


def rising(until_s):
    """Return a filter whose fixes rise by 1 m each second, which the model does not explain."""
    found = VerticalFilter()
    for second in range(until_s + 1):
        found.fuse_fix(float(second), 0.0, 300.0 + second)
    return found


def test_without_fixes_the_climb_error_returns_to_zero():
    lost = rising(40)
    assert lost.state_at(40.0, 0.0)[1] > 0.5
    assert lost.state_at(110.0, 0.0)[1] < 0.01
    risen_m = lost.altitude_at(110.0, 0.0) - lost.altitude_m
    assert risen_m == pytest.approx(CLIMB_TAU_S * lost.state_at(40.0, 0.0)[1], rel=0.02)


def test_the_deviation_without_fixes_grows_as_rising_air_displaces_an_aircraft():
    lost = rising(40)
    deviations = [lost.state_at(40.0 + seconds, 0.0)[2] for seconds in (0.0, 30.0, 120.0)]
    assert deviations[0] < 4.0
    assert deviations[1] == pytest.approx(28.0, abs=5.0)
    assert deviations[2] < 120.0, "not as that of a climb error that stays"


def test_one_step_predicts_as_many_do():
    one, many = rising(40), rising(40)
    for tenth in range(1, 200):
        many._advance(40.0 + 0.1 * tenth, 0.0)
    for each in (one, many):
        each._advance(60.0, 0.0)
    assert many.altitude_m == pytest.approx(one.altitude_m)
    assert many.state_at(60.0, 0.0)[1] == pytest.approx(one.state_at(60.0, 0.0)[1])
    assert many.state_at(70.0, 3.0)[0] == many.altitude_at(70.0, 3.0)
    for row, other in zip(one._p, many._p, strict=True):
        assert row == pytest.approx(other)


@pytest.mark.parametrize("h", [(1.0, 0.0, 1.0, 0.0), (1.0, -0.7, 0.0, 1.0)])
def test_a_correction_is_that_of_the_textbook(h):
    found = Level().fly(5, 2.0).filter
    p, x = [list(row) for row in found._p], list(found._x)
    found._correct(h, 0.4, 0.7)
    column = [math.fsum(a * b for a, b in zip(h, row, strict=True)) for row in p]
    variance = math.fsum(a * b for a, b in zip(h, column, strict=True)) + 0.7**2
    for i, gain in enumerate(each / variance for each in column):
        assert found._x[i] == pytest.approx(x[i] + gain * 0.4)
        wanted = [p[i][k] - gain * column[k] for k in range(4)]
        assert found._p[i] == pytest.approx(wanted, abs=1e-9)
