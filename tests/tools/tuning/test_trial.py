"""A trial flight: the gains reach the firmware, the steps are flown, the same flight each time."""

import math
import struct

import pytest

from tests.tools.tuning.gains import FIRM
from tools.tuning.actuators import Mix
from tools.tuning.experiments import STEPS, Bench, fly_rough, fly_steps, yaw_swing
from tools.tuning.gain_set import ZERO, AxisGains, with_axis
from tools.tuning.trial import StickMove
from up.commands.gains import Gains, GainSet, LoopGains
from up_simulator.aircraft import load_airframe
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import SettingsError

ODD = GainSet(
    LoopGains(Gains(2.5, 0.5, 0.125), Gains(1.5), Gains(0.75)),
    LoopGains(Gains(4.0), Gains(3.0), ZERO),
)


def test_the_board_flies_with_the_gains_on_trial(bench):
    trial = bench.trial(ODD)
    tap = LineMonitor()
    trial.board.write(tap.command_bytes("G"))
    trial.fly(0.1)
    tap.feed(trial.board.read(), 0.0)
    (answer,) = (each for each in tap.take_answers() if each.type == "G")
    flown = struct.unpack(">18f", answer.payload)
    assert flown == (2.5, 0.5, 0.125, 1.5, 0, 0, 0.75, 0, 0, 4, 0, 0, 3, 0, 0, 0, 0, 0)


def test_gains_out_of_range_are_refused(bench):
    wild = with_axis(FIRM, "roll", AxisGains(Gains(51.0), Gains(1.0)))
    with pytest.raises(SettingsError) as caught:
        bench.trial(wild)
    assert caught.value.code == "gain_out_of_range"


def test_the_sticks_move_when_they_are_to(bench):
    trial = bench.trial(FIRM)
    recording = trial.fly(1.5, [StickMove(0.5, "ailerons", 2000.0)])
    rolls = dict(zip(recording.times_s, recording["truth.roll_deg"], strict=True))
    assert abs(rolls[min(rolls, key=lambda time_s: abs(time_s - 0.5))]) < 2
    assert recording["truth.roll_deg"][-1] > 15


@pytest.mark.parametrize("axis", ["roll", "pitch"])
def test_firm_gains_follow_a_step_better_than_soft_ones(bench, axis):
    soft = GainSet(LoopGains(Gains(1.0), Gains(0.6), ZERO), LoopGains(Gains(2.0), Gains(2.0), ZERO))
    plan = STEPS[axis]
    poor, good = (fly_steps(bench, gains, plan) for gains in (soft, FIRM))
    assert len(good.responses) == len(poor.responses) == len(plan.demands)
    assert good.rise_time_s < 0.8 * (poor.rise_time_s or math.inf)
    assert good.steady_error_percent < 0.6 * poor.steady_error_percent


def test_a_crash_ends_a_trial_and_is_reported(bench):
    trial = bench.trial(FIRM)
    dive = [StickMove(0, "elevator", 1000.0), StickMove(0, "throttle", 2000.0)]
    trial.board.set_stick("aux1", 1000.0)
    recording = trial.fly(120.0, [*dive, StickMove(0, "rudder", 2000.0)], sample_s=1.0)
    assert "ground" in recording.crash or "broke" in recording.crash


def test_rough_air_and_a_kicked_rudder_tell_firm_gains_from_none(bench):
    none = GainSet(LoopGains(ZERO, ZERO, ZERO), LoopGains(ZERO, ZERO, ZERO))
    loose = fly_rough(bench, none, seconds=5.0, seeds=(1,))
    held = fly_rough(bench, FIRM, seconds=5.0, seeds=(1,))
    assert held.roll_rms_deg < 0.4 * loose.roll_rms_deg
    damped = with_axis(FIRM, "yaw", AxisGains(Gains(3.0), ZERO))
    undamped = with_axis(FIRM, "yaw", AxisGains(ZERO, ZERO))
    assert yaw_swing(bench, damped) < 0.7 * yaw_swing(bench, undamped)


@pytest.mark.parametrize("mix", ["none", "elevon", "V-tail"])
def test_a_mix_and_its_inverse_cancel(mix):
    profile = {"mix": mix, "ailerons": {"reversed": True}, "rudder": {"reversed": True}}
    pulses = (1620.0, 1450.0, 1333.0, 1700.0)
    both = Mix(profile)
    assert both.pulses(both.axes(pulses), 1333.0) == pytest.approx(pulses)


@pytest.mark.parametrize(
    ("axis", "stick", "other"), [("roll", "ailerons", "pitch"), ("pitch", "elevator", "roll")]
)
def test_the_wing_turns_its_elevons_as_the_mix_says(axis, stick, other):
    """By the firmware's own mix: a stick to the right is roll alone, a pulled one pitch alone."""
    none = GainSet(LoopGains(ZERO, ZERO, ZERO), LoopGains(ZERO, ZERO, ZERO))
    gains = with_axis(none, axis, AxisGains(Gains(1.0), ZERO))
    trial = Bench(load_airframe("wing"), "host").trial(gains)
    seen = []
    trial.dynamics.on_step = lambda arriving, _moved: seen.append(arriving)
    trial.board.set_stick("aux1", 1000.0)
    trial.board.set_stick(stick, 1800.0)
    trial.fly(0.1)
    assert seen[-1][axis] > 15
    assert abs(seen[-1][other]) < 1
