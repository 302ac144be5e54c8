"""The flight controller on the Raspberry Pi: when it flies, on what, and with which gains."""

import math
import threading
from typing import ClassVar

import pytest

from raspilot.flight_modes.acro import Acro
from raspilot.flight_modes.fbw import FlyByWire
from tests.raspilot.flight_controller_rig import (
    BOARD,
    FBW_MODE,
    LOOP,
    MANUAL,
    OTHER_GAINS,
    PHONE,
    Rig,
)
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.flight_state_command import (
    FlightStateCommand,
    FlyByWireLimitsCommand,
)
from up.commands.gains import Gains, GainSet, LoopGains, gain_set_to_data
from up.commands.orientation_command import OrientationCommand
from up.commands.output_command import OutputCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.refusal import Code, CommandRefusedError
from up.commands.rx_command import ALL_VALID
from up.flight_controller.gains_store import GainsStore
from up.flight_controller.pids_file import PidsFile


def test_level_and_centred_it_holds_the_middle_and_leaves_the_throttle_to_the_stick(rig):
    assert rig.frame() == OutputCommand(1500, 1500, 0, 1500, 1)


def test_signs(rig):
    assert rig.frame(20.0).ailerons_us < 1500
    assert rig.frame(-20.0).ailerons_us > 1500
    assert rig.frame(0.0, 10.0).elevator_us < 1500
    assert rig.frame(0.0, -10.0).elevator_us > 1500
    rig.sticks(ailerons=1600, elevator=1400)
    output = rig.frame()
    assert output.ailerons_us > 1500 > output.elevator_us


def test_full_sticks_ask_for_the_limits_that_the_airframes_configuration_says(rig):
    rig.bus.execute_command(FlyByWireLimitsCommand(30.0, 10.0, 15.0))
    at_rest = OutputCommand(1500, 1500, 0, 1500, 1)
    rig.sticks(ailerons=2000, elevator=2000)
    assert rig.frame(30.0, 10.0, sequence=1) == at_rest
    rig.sticks(ailerons=1000, elevator=1000)
    rig.controller.reset()
    assert rig.frame(-30.0, -15.0, sequence=1) == at_rest


def test_what_the_airframes_configuration_does_not_say_is_as_a_new_board_has_it(rig):
    rig.bus.execute_command(FlyByWireLimitsCommand(30.0, 10.0, 15.0))
    rig.bus.execute_command(FlyByWireLimitsCommand())
    rig.sticks(ailerons=2000, elevator=1000)
    assert rig.frame(50.0, -25.0) == OutputCommand(1500, 1500, 0, 1500, 1)


def test_inverted_it_demands_a_faster_roll_until_it_is_at_90_degrees(tmp_path):
    loop = LoopGains(Gains(1.0), Gains(1.0), Gains(0.0))
    rig = Rig(tmp_path, gains=GainSet(loop, LoopGains(Gains(8.0), Gains(8.0))))
    rig.state()
    rig.sticks()
    assert [rig.frame(roll).ailerons_us for roll in (-170.0, 90.0, 89.0)] == [1781, 1219, 1350]


def test_the_rudder_is_the_stick_and_a_damper(rig):
    rig.sticks(rudder=1700)
    assert rig.frame().rudder_us == 1700
    assert rig.frame(rates=(0.0, 0.0, 30.0)).rudder_us < 1700


@pytest.mark.parametrize("sequence", [0, 1, 65535])
def test_the_sequence_of_the_frame_is_carried(rig, sequence):
    assert rig.frame(sequence=sequence).sequence == sequence


def test_pulses_stay_within_their_limits(rig):
    rig.sticks(ailerons=3000, elevator=0, rudder=3000)
    output = rig.frame(-360.0, 360.0, rates=(-4000.0, 4000.0, 0.0))
    assert (output.ailerons_us, output.elevator_us, output.rudder_us) == (2000, 1000, 2000)
    OutputCommand.from_data(output.data)


class TestNothingIsSent:
    """Without the inputs of control there is no Output: the board flies alone."""

    def test_before_the_board_lets_it(self, tmp_path):
        rig = Rig(tmp_path)
        rig.sticks()
        assert rig.frame() is None

    @pytest.mark.parametrize(
        "state", [FBW_MODE, MANUAL, FlightStateCommand(None, False, False, False)]
    )
    def test_when_the_board_flies_itself(self, rig, state):
        assert rig.frame()
        rig.state(state)
        assert rig.frame() is None
        rig.state()
        assert rig.frame()

    def test_without_a_valid_receiver(self, rig):
        rig.sticks(valid=ALL_VALID & ~1)
        assert rig.frame() is None
        rig.sticks()
        assert rig.frame()

    def test_with_a_stale_receiver(self, rig):
        rig.clock.advance(0.22)
        assert rig.frame()
        assert rig.frame() is None

    def test_without_any_receiver(self, tmp_path):
        rig = Rig(tmp_path)
        rig.state()
        assert rig.frame() is None

    def test_from_a_frame_without_a_sequence(self, rig):
        rig.bus.execute_command(OrientationCommand(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None), BOARD)
        assert not rig.outputs

    def test_from_the_phone_even_if_it_names_a_sequence(self, tmp_path):
        rig = Rig(tmp_path, providers="orientation: [android, arduino]\n")
        rig.state()
        rig.sticks()
        assert rig.frame(origin=PHONE) is None
        assert rig.up.get_modules(type(rig.manager.orientation))[0].reading.source == "android"
        assert rig.frame() is None

    @pytest.mark.parametrize("bad", [math.nan, math.inf])
    def test_from_what_is_no_number_and_the_next_frame_is_as_good_as_ever(self, rig, bad):
        good = rig.frame(5.0)
        assert rig.frame(bad) is None
        assert rig.frame(rates=(bad, 0.0, 0.0)) is None
        rig.clock.advance(0.2)
        rig.sticks()
        assert rig.frame(5.0).ailerons_us == good.ailerons_us
        assert rig.bus.counters["failed_handlers"] == 0


def test_without_rates_the_sticks_pass_through(rig):
    rig.sticks(ailerons=1234, elevator=1777, rudder=900)
    output = rig.frame(30.0, 10.0, rates=(None, None, None))
    assert output == OutputCommand(1234, 1777, 0, 1000, 1)
    assert rig.manager.acting_mode == "ACRO"


class TestThePast:
    """Integrals and derivatives are of this flight and this moment."""

    def wind_up(self, rig):
        for _ in range(20):
            rig.sticks(ailerons=1600)
            rig.frame()

    def test_after_a_gap_it_begins_anew(self, rig):
        rig.sticks(ailerons=1600)
        rig.clock.advance(0.08)
        first = rig.frame()
        self.wind_up(rig)
        assert rig.outputs[-1].ailerons_us > first.ailerons_us
        rig.clock.advance(1.0)
        rig.sticks(ailerons=1600)
        assert rig.frame().ailerons_us == first.ailerons_us

    def test_after_the_board_flew_for_a_while_it_begins_anew(self, rig):
        rig.sticks(ailerons=1600)
        rig.clock.advance(0.08)
        first = rig.frame()
        self.wind_up(rig)
        rig.state(FBW_MODE)
        for _ in range(20):
            assert rig.frame() is None
        rig.state()
        rig.sticks(ailerons=1600)
        assert rig.frame().ailerons_us == first.ailerons_us

    def test_after_passing_through_it_begins_anew(self, rig):
        rig.sticks(ailerons=1600)
        self.wind_up(rig)
        wound = rig.outputs[-1].ailerons_us
        for _ in range(20):
            rig.sticks(ailerons=1600)
            rig.frame(rates=(None, None, None))
        assert rig.frame().ailerons_us < wound

    def test_two_frames_at_once_are_no_division_by_zero_and_no_kick(self, rig):
        rig.frame()
        before = rig.frame(0.5)
        rig.attitude(0.5, rates=(0.01, 0.0, 0.0))
        assert len(rig.outputs) == 3
        assert abs(rig.outputs[-1].ailerons_us - before.ailerons_us) < 20


class Impatient(FlyByWire):
    """An author's mode that wants newer readings than the one it replaces."""

    NEEDS: ClassVar = {"rx": 0.03, "orientation": 0.02}
    FALLBACK: ClassVar = ""


def test_the_ages_of_a_mode_limit_the_control_step(tmp_path):
    rig = Rig(tmp_path, modes=(Impatient, Acro))
    rig.state()
    rig.sticks()
    assert rig.frame() is not None
    assert rig.frame() is None, "the receiver's inputs are 40 ms old"


class TestGains:
    """Taken whole or not at all, saved beside the flight."""

    def test_a_corrupt_file_is_a_veto_and_the_last_good_set_flies(self, tmp_path):
        PidsFile(tmp_path).save(OTHER_GAINS)
        (tmp_path / "pids.yml").write_text("rate: {ailerons: {p: 6}}\n")
        rig = Rig(tmp_path, gains=None)
        assert "pids.yml" in rig.up.vetoes.own
        assert rig.controller.gains.rate == LOOP

    def test_asking(self, rig):
        assert rig.outcome(PIDTuningsCommand(request=True)) == [None]
        assert rig.ground.sent == [PIDTuningsValuesCommand.of(rig.controller.gains)]
        rig.ground.is_there = False
        (got,) = rig.outcome(PIDTuningsCommand(request=True))
        assert got.check(CommandRefusedError)

    def test_setting_acts_at_once_is_saved_and_mends_the_veto(self, tmp_path):
        (tmp_path / "pids.yml").write_text("rubbish")
        new = GainSet(LoopGains(Gains(9.0), Gains(1.0)), LoopGains(Gains(8.0), Gains(1.0)))

        async def scenario():
            rig = Rig(tmp_path, gains=None, clock=reactor)
            assert "pids.yml" in rig.up.vetoes.own
            before = rig.controller.gains
            got = rig.outcome(PIDTuningsCommand(pids=gain_set_to_data(new)))
            assert rig.controller.gains == new.completed(before)
            await until(lambda: got)
            assert got == [None]
            assert "pids.yml" not in rig.up.vetoes.own
            return rig.controller.gains

        flown = run_in_reactor(scenario)
        assert PidsFile(tmp_path).load() == (flown, None)

    def test_a_slow_disk_holds_nobody_and_the_newest_set_wins(self, tmp_path):
        saved, disk = [], threading.Event()

        class SlowFile:
            def save(self, gains):
                assert disk.wait(60)
                saved.append(gains)

        async def scenario():
            keeper = GainsStore(SlowFile(), reactor)
            done = [keeper.save("first"), keeper.save("second"), keeper.save("third")]
            assert not saved
            disk.set()
            for each in done:
                await each

        run_in_reactor(scenario)
        assert len(saved) == 3 and saved[-1] == "third"

    def test_a_disk_that_refuses_is_said_and_the_gains_fly(self, tmp_path, monkeypatch):
        def refuse(self, gains):
            raise OSError(28, "No space left on device")

        async def scenario():
            rig = Rig(tmp_path, clock=reactor)
            monkeypatch.setattr(PidsFile, "save", refuse)
            got = rig.outcome(PIDTuningsCommand(pids=gain_set_to_data(OTHER_GAINS)))
            await until(lambda: got)
            assert got[0].value.code is Code.FAILED
            assert rig.controller.gains.rate == LOOP
            rig.bus.limited.stop()

        run_in_reactor(scenario)
