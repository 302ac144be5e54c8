"""The cascade: signs, limits, windup, and a closed loop."""

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from simple_pid import PID

from raspilot.flight_controller import sticks
from raspilot.flight_controller.cascade import (
    OUTPUT_LIMIT,
    US_PER_UNIT,
    WASHOUT_S,
    Cascade,
    Pid,
    YawDamper,
    pitch_rate_in_turn,
)
from up.commands.flight_state_command import FlyByWireLimitsCommand
from up.commands.gains import Gains
from up.flight_controller.pids_file import PidsConfig, gain_set_of

LIMIT_US = OUTPUT_LIMIT * US_PER_UNIT
DT_S = 0.02
DEFAULTS = gain_set_of(PidsConfig())


def cascade(rate=None, stabilize=None, limit=120.0):
    return Cascade(rate or Gains(2.1), stabilize or Gains(2.0), limit)


@pytest.mark.parametrize(
    ("wanted", "angle", "rate", "sign"),
    [
        (10, 0, 0, 1),
        (-10, 0, 0, -1),
        (0, 10, 0, -1),
        (0, -10, 0, 1),
        (0, 0, 30, -1),
        (0, 0, -30, 1),
    ],
)
def test_it_steers_against_the_error_and_against_the_rotation(wanted, angle, rate, sign):
    assert math.copysign(1, cascade().hold_angle(wanted, angle, rate, DT_S)) == sign


def test_the_figures():
    assert cascade().hold_angle(10, 0, 0, DT_S) == pytest.approx(10 * 2.0 * 2.1 * 1.25)
    assert cascade().hold_rate(30, 10, DT_S) == pytest.approx(20 * 2.1 * 1.25)
    assert cascade().hold_angle(0, 0, 0, DT_S) == 0


def test_the_wanted_rate_is_limited():
    small = Gains(1.0)
    assert cascade(small, Gains(50.0)).hold_angle(50, -50, 0, DT_S) == pytest.approx(120 * 1.25)


@given(
    st.builds(Gains, st.floats(0, 50), st.floats(0, 50), st.floats(0, 50)),
    st.lists(
        st.tuples(st.floats(-400, 400), st.floats(-4000, 4000), st.floats(1e-3, 0.1)), max_size=20
    ),
)
def test_a_pid_computes_the_same_as_simple_pid(gains, steps):
    mine, peer = Pid(gains, 400.0), PID(*gains, sample_time=None, output_limits=(-400, 400))
    for wanted, measured, dt_s in steps:
        peer.setpoint = wanted
        assert mine.step(wanted, measured, dt_s) == pytest.approx(peer(measured, dt=dt_s))


def test_reset_forgets():
    controller = cascade(Gains(1.0, 5.0, 0.5), Gains(1.0, 5.0, 0.5))
    first = controller.hold_angle(20, 0, 0, DT_S)
    for _ in range(100):
        controller.hold_angle(20, 0, 0, DT_S)
    assert controller.hold_angle(20, 0, 0, DT_S) != pytest.approx(first)
    controller.reset()
    assert controller.hold_angle(20, 0, 0, DT_S) == pytest.approx(first)


def test_tuning_acts_at_once_and_keeps_what_the_integral_holds():
    controller = cascade(Gains(0.0, 1.0), Gains(1.0))
    for _ in range(50):
        held = controller.hold_rate(10, 0, DT_S)
    controller.tune(Gains(2.0), Gains(1.0))
    assert controller.hold_rate(0, 0, DT_S) == pytest.approx(held, rel=0.01)


def roll_of(controller, wanted_deg, seconds, gust_deg_s2=0.0):
    """Fly a model whose roll rate follows the ailerons; return its bank over time."""
    bank, rate, banks = 0.0, 0.0, []
    for _ in range(round(seconds / DT_S)):
        deflection = controller.hold_angle(wanted_deg, bank, rate, DT_S) / LIMIT_US
        rate += (deflection * 900.0 - 5.0 * rate + gust_deg_s2) * DT_S
        bank += rate * DT_S
        banks.append(bank)
    return banks


@pytest.mark.parametrize("wanted", [30.0, -45.0])
def test_the_closed_loop_reaches_the_bank_and_stays(wanted):
    banks = roll_of(cascade(DEFAULTS.rate.ailerons, DEFAULTS.stabilize.ailerons), wanted, 10)
    assert banks[-1] == pytest.approx(wanted, abs=0.5)
    assert max(abs(bank) for bank in banks) < abs(wanted) * 1.05
    assert all(bank == pytest.approx(wanted, abs=1.0) for bank in banks[-100:])


def test_the_integral_holds_against_a_steady_gust():
    without = roll_of(cascade(Gains(0.5), Gains(2.0)), 0.0, 20, 100.0)[-1]
    with_it = roll_of(cascade(Gains(0.5, 0.5), Gains(2.0)), 0.0, 20, 100.0)[-1]
    assert abs(without) > 5
    assert abs(with_it) < 0.5


def test_a_reversed_sensor_would_be_seen():
    """The loop above can fail: with the sign turned round it diverges."""
    controller = cascade(Gains(0.5), Gains(2.0))
    hold = controller.hold_angle
    bank, rate = 1.0, 0.0
    for _ in range(200):
        deflection = -hold(0.0, bank, rate, DT_S) / LIMIT_US
        rate += (deflection * 900.0 - 5.0 * rate) * DT_S
        bank += rate * DT_S
    assert abs(bank) > 5


class TestYawDamper:
    """Swinging is damped, a turn passes."""

    def test_against_a_swing(self):
        damper = YawDamper(Gains(0.5))
        damper.deflection_us(0.0, DT_S)
        assert damper.deflection_us(20.0, DT_S) < 0
        assert damper.deflection_us(-20.0, DT_S) > 0

    def test_a_steady_turn_is_let_pass(self):
        damper = YawDamper(Gains(0.5))
        damper.deflection_us(0.0, DT_S)
        pushes = [damper.deflection_us(20.0, DT_S) for _ in range(round(5 * WASHOUT_S / DT_S))]
        assert pushes[0] < -10
        assert abs(pushes[-1]) < 0.2

    def test_limits_reset_and_no_gain(self):
        damper = YawDamper(Gains(50.0))
        damper.deflection_us(-4000.0, DT_S)
        assert damper.deflection_us(4000.0, DT_S) == -LIMIT_US
        damper.reset()
        assert damper.deflection_us(4000.0, DT_S) == pytest.approx(0, abs=1e-9)
        damper.tune(Gains(0.0))
        assert damper.deflection_us(-4000.0, DT_S) == 0


@pytest.mark.parametrize(
    ("stick", "roll", "pitch"),
    [(1500, 0, 0), (2000, 50, 20), (1000, -50, -25), (3000, 50, 20), (0, -50, -25), (1750, 25, 10)],
)
def test_sticks(stick, roll, pitch):
    assert sticks.roll_deg(stick) == roll
    assert sticks.pitch_deg(stick) == pitch


def test_sticks_within_other_limits():
    limits = sticks.Limits.of(FlyByWireLimitsCommand(roll_deg=30.0, pitch_down_deg=0.0))
    assert limits == sticks.Limits(30.0, 20.0, 0.0)
    assert sticks.roll_deg(1750, limits) == 15
    assert sticks.pitch_deg(2000, limits) == 20
    assert sticks.pitch_deg(1000, limits) == 0


@pytest.mark.parametrize("bank_deg", [-49, -20, 20, 49, 60])
def test_a_banked_aircraft_pitches_with_its_turn(bank_deg):
    turn_deg_s = math.copysign(20, bank_deg)
    bank = math.radians(bank_deg)
    rate = pitch_rate_in_turn(0.0, bank_deg, turn_deg_s * math.cos(bank))
    assert rate == pytest.approx(turn_deg_s * math.sin(bank))
    assert pitch_rate_in_turn(10.0, bank_deg, 0.0) == pytest.approx(10 * math.cos(bank))


@pytest.mark.parametrize("bank_deg", [90, -91, 120, 180])
def test_beyond_90_degrees_of_bank_the_elevator_waits(bank_deg):
    assert pitch_rate_in_turn(80.0, bank_deg, 50.0) == pytest.approx(0, abs=1e-9)


def test_towards_90_degrees_the_offset_falls_to_nothing_without_a_jump():
    rates = [pitch_rate_in_turn(0.0, each / 10, 30.0) for each in range(901)]
    assert max(abs(after - before) for before, after in itertools.pairwise(rates)) < 0.3
    assert rates[-1] == pytest.approx(0, abs=0.1)
