"""`python main.py` and the compiled firmware, on a real pty; time is the board's own."""

import itertools
import os
import signal
from pathlib import Path

import pytest

from tests.cogs.arduino_cog.bench_board import ms
from tests.cogs.arduino_cog.flying import await_profile, firmware, flying
from up.commands.gains import gain_set_to_data
from up.flight_controller.pids_file import PIDS, gain_set_of
from up_rig import CYCLES_PER_US
from up_rig.imu import motion_at

AIRFRAME = "rudder: {trim_us: 40}\nfly_by_wire: {roll_deg: 33.333}\n"
# Not the default of a board.
GAINS = PIDS.template().replace("p: 2.0", "p: 2.25")
PANIC = "panic threshold: 1\ncalm down threshold: 0\ninterval: 0.1\n"
NO_GAINS = "\n".join(line.split(":")[0] + ": 0.0" if " p:" in line or " i:" in line
                     or " d:" in line else line for line in PIDS.template().splitlines()
                     if not line.lstrip().startswith("#"))  # fmt: skip

SENT = ("gains_sent", "profile_sent")


@pytest.fixture(scope="module")
def elf():
    return firmware()


@pytest.fixture(scope="module")
def flight(elf, tmp_path_factory):
    folder = tmp_path_factory.mktemp("firmware")
    files = {"pids": GAINS, "airframe": AIRFRAME}
    with flying(elf, folder, motion=motion_at(6.0, -4.0), **files) as both:
        yield both


def near(value, wanted, tolerance):
    return value is not None and abs(value - wanted) <= tolerance


def disarm(board, ground):
    board.move(throttle=1000, aux2=1000)
    ground.sees("disarmed by AUX2", armed=False)


def arm(board, ground):
    disarm(board, ground)
    only = ["arduino: AUX2 is low"]
    board.wait(lambda: ground.at("vetoes") == only, "nothing else against arming")
    # The firmware arms on an edge that follows 300 ms of low.
    board.pass_us(400_000)
    board.move(aux2=2000)
    ground.sees("armed by AUX2", armed=True)


def test_orientation_inputs_and_outputs_reach_the_ground(flight):
    board, daemon = flight
    ground = daemon.ground
    board.move(aux1=1000, ailerons=1620, elevator=1410)
    ground.comes("orientation.roll", 6.0, 1.0)
    ground.comes("orientation.pitch", -4.0, 1.0)
    ground.comes("rx.ailerons", 1620, 3)
    ground.comes("servo.ailerons", 1620, 3)
    board.gives("ailerons", 1620, 3)
    ground.sees("the switch", flight_mode="ACRO", arduino__switch="low")
    assert ground.at("arduino.imu_valid") is True
    assert ground.at("arduino.restored") is False
    assert ground.at("source.orientation") == "arduino"


def test_the_gains_of_pids_yml_are_pushed_and_read_back(flight):
    _, daemon = flight
    assert daemon.ground.ask("arduino.pids.tunings", request=True) == ""
    current = daemon.ground.content("arduino.pids.values")
    wanted = gain_set_to_data(gain_set_of(PIDS.parse(GAINS, Path("pids.yml"))))
    assert wanted["ratePIDs"]["ailerons"]["p"] == 2.25
    assert current["ratePIDs"] == wanted["ratePIDs"]
    assert current["stabPIDs"] == wanted["stabPIDs"]
    assert daemon.logged("gains_sent")


def test_the_profile_of_airframe_yml_is_pushed_and_flown(flight):
    board, daemon = flight
    assert daemon.ground.ask("arduino.profile.request") == ""
    profile = daemon.ground.content("arduino.profile.values")
    assert profile["rudder"]["trim_us"] == 40
    assert profile["fly_by_wire"]["roll_deg"] == 33.33
    assert profile["mix"] == "none"
    changes = "rudder.trim_us 0, wanted 40; fly_by_wire.roll_deg 50.0, wanted 33.33"
    assert daemon.logged("profile_sent")[-1]["text"] == changes
    board.move(aux1=1000, rudder=1500)
    board.gives("rudder", 1540, 3)
    assert not [veto for veto in daemon.ground.at("vetoes") if "airframe.yml" in veto]


def test_arming_by_aux2_and_by_the_ground(flight):
    board, daemon = flight
    ground = daemon.ground
    disarm(board, ground)
    assert ground.ask("up.arm") == "veto"
    arm(board, ground)
    board.move(throttle=1500)
    board.gives("throttle", 1500, 3)
    assert ground.ask("up.disarm") == "throttle_not_low"
    board.move(throttle=1000)
    ground.comes("rx.throttle", 1000, 3)
    board.pass_us(2_300_000)
    assert ground.ask("up.disarm") == ""
    ground.sees("disarmed by the ground", armed=False)
    board.move(throttle=1500)
    ground.comes("rx.throttle", 1500, 3)
    assert ground.ask("up.arm") == "throttle_not_low"
    board.move(throttle=1000)
    ground.comes("rx.throttle", 1000, 3)
    assert ground.ask("up.arm") == ""
    ground.sees("armed by the ground", armed=True)
    disarm(board, ground)


def test_modes_are_taken_at_auto_only(flight):
    board, daemon = flight
    ground = daemon.ground
    board.move(aux1=2000)
    ground.sees("the switch", arduino__switch="high")
    assert ground.ask("up.flight_mode.set", mode="RATE") == ""
    ground.sees("RATE", flight_mode="RATE")
    assert ground.ask("up.flight_mode.set", mode="FBW") == ""
    ground.sees("FBW", flight_mode="FBW")
    assert ground.ask("up.flight_mode.set", mode="ACRO") == "mode_unknown"
    board.move(aux1=1000)
    ground.sees("the switch", arduino__switch="low", flight_mode="ACRO")
    assert ground.ask("up.flight_mode.set", mode="RATE") == "not_at_auto"
    board.pass_us(300_000)
    assert ground.at("flight_mode") == "ACRO"


def test_a_reset_in_flight_is_told_and_gets_nothing_but_start(flight):
    board, daemon = flight
    ground = daemon.ground
    arm(board, ground)
    board.move(throttle=1400)
    ground.comes("rx.throttle", 1400, 3)
    pushed = len(daemon.logged(*SENT))
    with board.rig() as rig:
        rig.force_watchdog_reset()
    ground.sees("the restored state", arduino__restored=True, armed=True)
    assert "watchdog" in ground.at("arduino.reset_cause")
    # A machine that is busy may have taken the pause for silence.
    reset = board.wait(lambda: daemon.logged("board_reset", "board_restored"), "the log")
    assert reset[-1]["reset_cause"] == "watchdog, state restored" and reset[-1]["armed"]
    board.gives("throttle", 1400, 3)
    board.pass_us(1_000_000)
    assert len(daemon.logged(*SENT)) == pushed
    disarm(board, ground)


def test_calibrating_is_refused_while_armed_and_by_the_board_while_it_moves(flight):
    board, daemon = flight
    ground = daemon.ground
    arm(board, ground)
    for what in ("level", "gyro", "receiver_begin"):
        assert ground.ask("arduino.calibrate", what=what) == "in_flight"
    disarm(board, ground)
    with board.rig() as rig:
        rig.imu.motion = motion_at(6.0, -4.0, (0.0, 0.0, 20.0))
    board.pass_us(300_000)
    board.wait(lambda: ground.ask("arduino.calibrate", what="gyro") == "not_still", "the refusal")
    with board.rig() as rig:
        rig.imu.motion = motion_at(6.0, -4.0)


def test_level_is_calibrated(flight):
    board, daemon = flight
    ground = daemon.ground
    disarm(board, ground)
    board.wait(lambda: ground.ask("arduino.calibrate", what="level") == "", "stillness")
    ground.comes("orientation.roll", 0.0, 0.5)
    assert near(ground.at("orientation.pitch"), 0.0, 0.5)
    board.wait(lambda: ground.ask("arduino.calibrate", what="gyro") == "", "stillness")


def test_the_flight_battery_is_calibrated_from_the_ground(flight):
    board, daemon = flight
    ground = daemon.ground
    disarm(board, ground)
    assert ground.at("arduino.flight_battery_v") is None
    # After a count at its end the filter begins at the next.
    for volts in (1.2, 0.9):
        with board.rig() as rig:
            rig.set_analog(7, volts)
        board.pass_us(100_000)
        outcome = ground.ask("up.battery.calibrate", voltage=11.34)
        assert outcome == ("battery_not_measured" if volts > 1.1 else "")
    ground.comes("arduino.flight_battery_v", 11.34, 0.02)
    arm(board, ground)
    assert ground.ask("up.battery.calibrate", voltage=12.0) == "in_flight"
    disarm(board, ground)


def test_the_receivers_ends_are_calibrated(flight):
    board, daemon = flight
    ground = daemon.ground
    disarm(board, ground)
    assert ground.ask("arduino.calibrate", what="receiver_end") == "out_of_range"
    assert ground.ask("arduino.calibrate", what="receiver_begin") == ""
    board.wait(lambda: "arduino: calibrating" in (ground.at("vetoes") or []), "the veto")
    channels = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
    for end_us in (1100, 1900):
        board.move(**dict.fromkeys(channels, end_us))
        board.pass_us(400_000)
    board.move(ailerons=1500, elevator=1500, rudder=1500, throttle=1100, aux1=1100, aux2=1100)
    board.pass_us(400_000)
    assert ground.ask("arduino.calibrate", what="receiver_end") == ""
    board.move(ailerons=1900)
    board.gives("ailerons", 2000, 8)
    board.wait(lambda: "arduino: calibrating" not in ground.at("vetoes"), "the end")


def test_what_was_set_outlives_power(flight):
    board, daemon = flight
    ground = daemon.ground
    board.pass_us(2_000_000)
    board.end()
    ground.sees("the board is gone", arduino__connected=False)
    pushed = len(daemon.logged(*SENT))
    compared = len(daemon.logged("gains_equal"))
    board.fly()
    ground.sees("the board is back", arduino__connected=True)
    board.wait(lambda: len(daemon.logged("gains_equal")) > compared, "gains")
    ground.comes("orientation.roll", 0.0, 0.5)
    await_profile(board, ground)
    assert len(daemon.logged(*SENT)) == pushed


def test_a_start_on_a_rocking_boat_is_told(flight):
    board, daemon = flight
    board.end()
    daemon.ground.sees("the board is gone", arduino__connected=False)
    board.motion = lambda time_s: motion_at(
        6.0, -4.0, (0.0, 0.0, 30.0 if time_s % 1 < 0.5 else -30)
    )
    board.fly()
    daemon.ground.sees("an old bias", arduino__bias_stored=True, arduino__imu_valid=True)


def periods_ms(board, letter, since):
    """Return the distances of one type's frames on the line, in the board's time."""
    cycles = [cycle for cycle, type_, _ in board.frames if type_ == letter and cycle > since]
    return [ms(after - before) for before, after in itertools.pairwise(cycles)]


RESTARTED = 3
"""A period that is requested again, without an answer in time on a busy machine, begins again."""


def off(found_ms, wanted_ms, by_ms):
    return sum(not near(each, wanted_ms, by_ms) for each in found_ms)


def test_panic_slows_the_streams_that_nobody_controls_by(elf, tmp_path):
    with flying(elf, tmp_path, load_guard=PANIC) as (board, daemon):
        daemon.ground.sees("panic", load__panic=True)
        board.pass_us(500_000)
        with board.rig() as rig:
            since = rig.cycle
        board.pass_us(1_500_000)
        for letter in "irO":
            found_ms = periods_ms(board, letter, since)
            assert off(found_ms, 150, 12) <= RESTARTED, letter
            assert 7 <= len(found_ms) <= 11


@pytest.fixture
def raspberry(elf, tmp_path):
    """The Raspberry Pi controls, with gains that hold all surfaces neutral at any bank."""
    config = "flight controller: raspberry\n"
    files = {"config": config, "pids": NO_GAINS, "load_guard": PANIC}
    with flying(elf, tmp_path, motion=motion_at(20.0, 0.0), **files) as (board, daemon):
        arm(board, daemon.ground)
        daemon.ground.sees("the Raspberry Pi flies", flight_mode="OUTPUT")
        yield board, daemon


def test_the_raspberry_flies_by_the_pins_and_panic_leaves_it_its_streams(raspberry):
    board, daemon = raspberry
    board.gives("ailerons", 1500, 1)
    daemon.ground.sees("panic", load__panic=True)
    board.pass_us(500_000)
    with board.rig() as rig:
        since = rig.cycle
    board.pass_us(1_000_000)
    for letter in "iO":
        assert off(periods_ms(board, letter, since), 20, 6) <= RESTARTED, letter
    assert off(periods_ms(board, "r", since), 150, 12) <= RESTARTED
    board.move(ailerons=1700)
    daemon.ground.comes("rx.ailerons", 1700, 3)
    widths = [p.width_us for p in board.pulses("ailerons") if p.rise_cycle > since]
    assert all(near(width, 1500, 1) for width in widths), "without gains the stick moves nothing"
    # The pilot takes over by the switch: the stick reaches the pins immediately.
    board.move(aux1=1000)
    board.gives("ailerons", 1700, 3)


def all_neutral(pulses):
    return all(near(each.width_us, 1500, 1) for each in pulses)


class Cut:
    """Ends a program in the middle of a frame: half of the next frame still passes.

    It waits for a frame while the program holds the ailerons neutral: on a busy machine the board
    may be levelling instead, because the last Output has ended.
    """

    def __init__(self, board, pid):
        self.board = board
        self.pid = pid
        self.cycle = None

    def __call__(self, data):
        if self.cycle is not None:
            return b""
        # Frames with an Output are 16 bytes; shorter ones are the veto's.
        pulses = self.board._rig.servo.pulses("ailerons")[-5:]
        if len(data) < 16 or not data.endswith(b"\0") or not all_neutral(pulses):
            return data
        os.kill(self.pid, signal.SIGKILL)
        self.cycle = self.board._rig.cycle
        return data[: len(data) - 8]


def test_a_daemon_killed_in_mid_frame_leaves_the_aircraft_to_the_board(raspberry):
    board, daemon = raspberry
    board.gives("ailerons", 1500, 1)
    cut = Cut(board, daemon.process.pid)
    board.gate = cut
    board.wait(lambda: cut.cycle is not None, "an Output to cut")
    assert daemon.end(signal.SIGKILL) == -signal.SIGKILL
    board.pass_us(1_000_000)
    pulses = board.pulses("ailerons")
    assert all_neutral([each for each in pulses if each.rise_cycle <= cut.cycle][-5:])
    # 250 ms, the servo frame in which they end, and the line's last bytes.
    limit = cut.cycle + 275_000 * CYCLES_PER_US
    after = [each for each in pulses if each.rise_cycle > limit]
    assert len(after) > 20
    # The board holds level: at 20 degrees of right bank the ailerons roll left.
    assert all(each.width_us < 1400 for each in after)
    assert all(880 <= each.width_us <= 2120 for each in pulses)
    rises = [each.rise_cycle for each in pulses]
    assert all(ms(b - a) < 30 for a, b in itertools.pairwise(rises)), "no pulse is left out"
    board.gate = None
    ground = daemon.start()
    ground.sees("the daemon is back and flies", armed=True, flight_mode="OUTPUT")
    board.gives("ailerons", 1500, 1)
