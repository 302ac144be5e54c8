"""The host build flies as the compiled firmware does: the same inputs, the same answers."""

import math
import random
import struct
from collections import Counter

import pytest

from tests.arduino.commands import outputs as output_command
from tests.arduino.commands import profile, setpoint
from tests.simulator.firmware.pair import STEP_US, Aboard, Pair, rocking
from up_rig.imu import motion_at
from up_simulator.aircraft import FlightDynamics, Start, load_airframe
from up_simulator.firmware.board import NEUTRAL_US
from up_simulator.firmware.host_board import HostBoard
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.rig_board import RigBoard
from up_simulator.harness.world import World

LOW, MIDDLE, HIGH = 1000, 1500, 2000
STREAMS = "xOir"
GAINS = struct.pack(">18f", *(0.125 * (1 + at) for at in range(18)))


@pytest.fixture
def pair(library, elf):
    """Return both, booted, level and still, the switch at ACRO."""
    return Pair(library, elf)


def test_it_boots_as_the_chip_does(library, elf):
    pair = Pair(library, elf, boots=False)
    pair.each("run_ms", 60)
    for each in (pair.host, pair.chip):
        assert each.board.pulses_us() == NEUTRAL_US
        assert each.board.pulse_ages_us() == (math.inf,) * 4
    pair.each("run_ms", 40)
    pair.agree_on_pulses()
    pair.each("run_ms", 1400)
    assert pair.agree_on_pulses() == NEUTRAL_US
    status = pair.agree("stands")
    assert (status.mode_letter, status.is_armed, status.is_imu_valid) == ("a", False, True)
    assert status.reset_cause == 1


@pytest.mark.parametrize("sticks", [(1000, 2000, 1700), (1234.5, 1765.5, 1111), (887, 2113, 2000)])
def test_sticks_come_out_as_from_the_chip(pair, sticks):
    ailerons, elevator, rudder = sticks
    pair.each("sticks", ailerons=ailerons, elevator=elevator, rudder=rudder)
    pulses = pair.agree_on_pulses()
    assert pulses[0] == pytest.approx(min(max(ailerons, 1000), 2000), abs=1.5)
    # Slaved to the receiver: a constant time after its pulses, in both.
    host, chip = (each.board.pulse_ages_us() for each in (pair.host, pair.chip))
    assert host == pytest.approx(chip, abs=3)
    pair.agree("stands")


def test_modes_arming_and_disarming_go_the_same_way(pair):
    seen = []
    for sticks in (
        {"aux1": MIDDLE},
        {"aux2": HIGH},
        {"throttle": 1600},
        {"aux1": HIGH},
        {"aux2": LOW},
        {"throttle": LOW},
        {"aux2": HIGH, "throttle": 1300},
        {"aux2": LOW},
        {"aux2": HIGH, "throttle": LOW},
        {"aux1": LOW},
    ):
        pair.each("sticks", **sticks)
        status = pair.agree("stands")
        seen.append((status.mode_letter, status.is_armed))
        pair.agree_on_pulses(within_us=2.0)
    assert {mode for mode, _ in seen} == {"a", "f"}
    assert {is_armed for _, is_armed in seen} == {True, False}


def test_attitude_and_fbw_pulses_follow_a_motion_alike(pair):
    pair.each("sticks", aux1=MIDDLE)
    pair.each("send", "s")
    widest, differences = 0.0, []
    for at in range(1500):
        pair.board("set_motion", rocking(at * STEP_US / 1e6))
        pair.each("run_ms", STEP_US / 1000)
        if at % 50 == 49:
            host, chip = pair.each("attitude")
            # Another message on the line delays the newest frame by up to a period of 20 ms.
            assert host == pytest.approx(chip, abs=0.3)
            differences.append(host[0] - chip[0])
            widest = max(widest, abs(host[0]))
            # A slot more or less of a motion of 15 deg/s, times the gains.
            pair.agree_on_pulses(within_us=2.0)
    assert widest > 12
    assert abs(sum(differences) / len(differences)) < 0.03


def test_commands_are_answered_alike(pair):
    assert pair.agree("answers", "m") == [("m", b"a")]
    for letter, payload in (
        ("G", b""),
        ("c", b""),
        ("a", b""),
        ("g", struct.pack(">18f", *(60.0 for _ in range(18)))),
        ("g", GAINS),
        ("G", b""),
        ("g", GAINS[:-1]),
        ("C", profile({"rudder": {"reversed": 1}}, circle_bank_cdeg=1500)),
        ("c", b""),
        ("M", b"f"),
        ("M", b"a"),
        ("p", struct.pack(">Bh", 1, 150)),
        ("e", b"\0"),
        ("e", b"\3"),
        ("e", b"\2"),
        ("Q", b"?"),
        ("d", b""),
    ):
        assert pair.agree("answers", letter, payload)
    pair.agree("stands")


def test_the_battery_is_measured_alike(pair):
    pair.board("set_a7", 1.0)
    pair.each("run_ms", 8000)
    assert pair.agree("answers", "V", (12500).to_bytes(2, "big")) == [("K", b"V\0")]
    for volts, within_v in ((1.0, (12.45, 12.52)), (0.8, (9.97, 10.03)), (1.2, (0.0, 0.0))):
        pair.board("set_a7", volts)
        pair.each("run_ms", 7000 if volts < 1 else 200)
        for status in pair.each("status"):
            assert within_v[0] <= status.battery_mv / 1000 <= within_v[1]


def test_raspberry_flies_both_alike(pair):
    pair.each("sticks", aux1=HIGH, aux2=HIGH)
    assert pair.agree("stands").is_armed
    for _ in range(10):
        pair.each("send", "S", setpoint(roll=2000, throttle=1400))
        pair.each("run_ms", 40)
    assert pair.agree("answers", "m") == [("m", b"s")]
    pulses = pair.agree_on_pulses(within_us=2.0)
    assert pulses[0] > 1510
    assert pulses[2] == pytest.approx(1400, abs=1)
    assert pair.agree("answers", "M", b"u")[0][0] == "K"
    pair.each("send", "s")
    for _ in range(10):
        for each in (pair.host, pair.chip):
            sequence = each.tap.orientation.sequence
            each.send("u", output_command(None, 1333, 1444, 0, 1555, sequence=sequence))
        pair.each("run_ms", 40)
    assert pair.agree_on_pulses()[::3] == pytest.approx((1333, 1555), abs=1)
    pair.each("run_ms", 500)
    assert pair.agree("stands").mode_letter == "f"


def test_streams_come_as_often(pair):
    for each in (pair.host, pair.chip):
        each.send("s")
        each.run_ms(2000)
    host, chip = (Counter(sent.type for sent in each.heard) for each in (pair.host, pair.chip))
    for letter in STREAMS:
        assert host[letter] == pytest.approx(chip[letter], abs=1)
    assert host["O"] >= 99
    assert pair.host.tap.bad_frames == 0


def test_bytes_of_any_kind_are_dropped_alike(pair):
    chance = random.Random(4)
    for _ in range(60):
        data = chance.randbytes(chance.randrange(1, 60)) + b"\0" * chance.randrange(2)
        pair.board("write", data)
        pair.each("run_ms", chance.choice((10, 20, 150)))
    for each in (pair.host, pair.chip):
        # A frame that was left unfinished swallows the first Command after it.
        each.send("s")
    dropped = pair.agree("stands").frame_errors
    assert dropped > 20


@pytest.mark.parametrize(
    ("width_us", "is_valid"), [(884, False), (886, True), (2114, True), (2116, False)]
)
def test_pulses_count_from_885_to_2115_us(pair, width_us, is_valid):
    pair.each("sticks", rudder=width_us)
    pair.each("sticks", wait_ms=400)
    status = pair.agree("stands")
    assert status.is_receiver_valid is is_valid
    host, chip = (
        [sent.payload[-1] for sent in each.heard if sent.type == "i"][-1]
        for each in (pair.host, pair.chip)
    )
    assert host == chip
    assert bool(host & 8) is is_valid


def test_a_lost_receiver_and_its_return_are_seen_alike(pair):
    pair.each("sticks", aux1=MIDDLE, aux2=HIGH, throttle=LOW)
    pair.each("sticks", throttle=1500, ailerons=1300)
    pair.board("set_receiver", False)
    pair.each("run_ms", 306)
    assert not pair.agree("stands").is_receiver_valid
    pair.each("run_ms", 500)
    status = pair.agree("stands")
    assert status.is_failsafe and status.is_armed
    # Slaved to nothing: it runs freely, with the pulses of the circle.
    pulses = pair.agree_on_pulses(within_us=2.0)
    assert pulses[0] > 1500
    assert pulses[2] == pytest.approx(1000, abs=1)
    pair.board("set_receiver", True)
    pair.each("run_ms", 600)
    status = pair.agree("stands")
    assert not status.is_failsafe and status.is_armed
    pair.agree_on_pulses(within_us=2.0)
    # Its frames went on unsent, and are in step with themselves.
    host, chip = (each.board.pulse_ages_us() for each in (pair.host, pair.chip))
    # Another interrupt delays a rise on the chip by up to 6 us.
    assert host == pytest.approx(chip, abs=6)


def test_one_silent_channel_is_no_receiver(pair):
    pair.board("set_channel", "elevator", False)
    pair.each("run_ms", 800)
    assert pair.agree("stands").is_failsafe
    pair.board("set_channel", "elevator", True)
    pair.each("run_ms", 300)
    assert not pair.agree("stands").is_failsafe


@pytest.mark.parametrize("fault", ["unplugged", "stuck", "frozen", "garbage"])
def test_a_faulty_imu_is_seen_alike_and_comes_back(pair, fault):
    pair.each("sticks", aux1=MIDDLE, ailerons=1600)
    for each in (pair.host, pair.chip):
        each.board.imu.set_fault(fault)
    pair.each("run_ms", 400)
    status = pair.agree("stands")
    assert (status.is_imu_valid, status.mode_letter) == (False, "a")
    assert pair.agree_on_pulses()[0] == pytest.approx(1600, abs=1)
    for each in (pair.host, pair.chip):
        each.board.imu.set_fault("well")
        assert each.board.imu.fault == "well"
    pair.each("run_ms", 1500)
    status = pair.agree("stands")
    assert (status.is_imu_valid, status.mode_letter) == (True, "f")


def test_eeprom_images_interchange_both_ways(library, elf):
    pair = Pair(library, elf)
    ends = {"ailerons": {"reversed": 1, "trim_us": -20}}
    for letter, payload in (("C", profile(ends, roll_limit_cdeg=3300)), ("g", GAINS)):
        assert pair.agree("answers", letter, payload)[0][0] == "K"
    pair.each("run_ms", 1200)
    from_host, from_chip = (each.board.eeprom for each in (pair.host, pair.chip))
    assert len(from_host) == 1024
    assert from_host == from_chip != b"\xff" * 1024
    again = [
        Aboard(RigBoard(elf, imu_errors=ImuErrors(), eeprom=from_host)),
        Aboard(HostBoard(library, imu_errors=ImuErrors(), eeprom=from_chip)),
    ]
    for each in again:
        each.run_ms(300)
        assert each.answers("G") == [("G", GAINS)]
        assert each.answers("c") == [("C", profile(ends, roll_limit_cdeg=3300))]
        each.board.set_stick("ailerons", 1600)
        each.run_ms(1500)
        assert each.board.pulses_us()[0] == pytest.approx(1380, abs=1)
        assert each.status().vetoes & 64 == 0
    broken = bytes(each if each == 0xFF else each ^ 0x10 for each in from_chip)
    both = Pair(library, elf, eeprom=broken)
    assert both.agree("stands").vetoes & 64


def test_status_has_the_acceleration_forward_that_does_not_turn_the_gyro(pair):
    pair.each("run_ms", 1500)
    assert [each.acceleration for each in pair.each("status")] == pytest.approx([128, 128], abs=1)
    pair.board("set_motion", motion_at(0, math.degrees(math.asin(0.25))))
    pair.each("run_ms", 500)
    assert [each.acceleration for each in pair.each("status")] == pytest.approx([144, 144], abs=2)


def armed_in_a_bank(pair):
    """Arm both in FBW and bank them 25 degrees, with a gyro that has a bias."""
    pair.each("sticks", aux1=MIDDLE)
    pair.each("sticks", aux2=HIGH)
    for at in range(250):
        turning = motion_at(at / 10, 0.0, (50.0, 0.0, 0.0))
        pair.board("set_motion", turning)
        pair.each("run_ms", 2)
    pair.board("set_motion", motion_at(25, 0))
    pair.each("sticks", throttle=1425, wait_ms=200)
    assert pair.agree("stands").is_armed


def test_a_watchdog_reset_in_flight_comes_back_armed_and_banked(library, elf):
    errors = ImuErrors(gyro_bias_deg_s=(3.0, -2.0, 1.5))
    pair = Pair(library, elf, imu_errors=errors)
    pair.each("run_ms", 1500)
    armed_in_a_bank(pair)
    pair.board("reset", "watchdog")
    pair.each("run_ms", 50)
    assert min(pair.host.board.pulse_ages_us()) > 15_000, "pulses came from a chip in reset"
    pair.each("run_ms", 450)
    status = pair.agree("stands")
    assert (status.mode_letter, status.is_armed, status.reset_cause) == ("f", True, 0x88)
    host, chip = pair.each("attitude")
    assert host == pytest.approx(chip, abs=0.1)
    assert host[0] == pytest.approx(25, abs=1)
    pulses = pair.agree_on_pulses(within_us=2.0)
    assert pulses[2] == pytest.approx(1425, abs=1)


@pytest.mark.parametrize(("cause", "bits"), [("power", 1), ("button", 2), ("brown-out", 4)])
def test_no_other_reset_arms(pair, cause, bits):
    armed_in_a_bank(pair)
    pair.board("reset", cause)
    pair.each("run_ms", 800)
    status = pair.agree("stands")
    assert (status.is_armed, status.reset_cause) == (False, bits)
    # Nor does the switch, which stands high: an edge is needed.
    pair.each("sticks", throttle=LOW)
    assert not pair.agree("stands").is_armed
    assert pair.agree_on_pulses(within_us=2.0)[2] == 1000
    pair.each("sticks", aux2=LOW)
    pair.each("sticks", aux2=HIGH)
    pair.each("run_ms", 10_500 if cause == "button" else 1500)
    assert pair.agree("stands").vetoes & ~(8 | 32) == 0


def test_a_flight_goes_the_same_way(library, elf):
    ends = []
    for board in (
        HostBoard(library, imu_errors=ImuErrors()),
        RigBoard(elf, imu_errors=ImuErrors()),
    ):
        world = World(FlightDynamics(load_airframe("glider"), Start(roll_deg=40.0)), board)
        board.set_stick("aux1", MIDDLE)
        world.boot(arms=True)
        world.advance(3.0)
        board.set_stick("ailerons", 1650)
        world.advance(2.0)
        ends.append((world.state.roll_deg, world.state.pitch_deg))
    # Other flights differ by 0.02 to 0.11 deg: their slots begin at other times.
    assert ends[0] == pytest.approx(ends[1], abs=0.15)
    assert ends[0][0] > 8
