"""Every Command of docs/protocols.md 2.3 on the compiled firmware: carried out, and refused."""

import struct

import pytest

from tests.arduino.flight import ARMED, GAINS_KEPT, HIGH, LOW, MIDDLE, Flight
from up_rig.imu import motion_at

OUT_OF_RANGE, ONLY_ON_GROUND, TOO_OLD, NOT_AT_AUTO = 3, 4, 6, 7
THROTTLE, RECEIVER, IMU, VETO, NOT_STILL, NOT_SUPPORTED = 8, 9, 10, 11, 12, 13
GAINS = tuple(0.25 * each for each in range(1, 19))
NAN, INFINITY = float("nan"), float("inf")


def gains(*values):
    return struct.pack(f">{len(values)}f", *values)


def outputs(flight, ailerons=1500, elevator=1500, throttle=0, rudder=1500, sequence=None):
    if sequence is None:
        sequence = flight.orientation_sequence()
    return struct.pack(">5H", ailerons, elevator, throttle, rudder, sequence)


def setpoint(roll=0, pitch=0, yaw_rate=0, throttle=0, lifetime_ms=250):
    return struct.pack(">3h2H", roll, pitch, yaw_rate, throttle, lifetime_ms)


@pytest.fixture
def auto(flight):
    """Return an armed aircraft with the switch at AUTO, forwarding."""
    flight.run_ms(1500)
    flight.arm()
    flight.sticks(aux1=HIGH)
    flight.send("s")
    flight.run_ms(50)
    return flight


def test_start_begins_the_streams_and_nothing_streams_before(flight):
    flight.run_ms(500)
    assert flight.messages == []
    assert flight.ask("s") == "K"
    flight.run_ms(1000)
    counts = {letter: sum(each.type == letter for each in flight.messages) for letter in "irOxo"}
    assert 48 <= counts["i"] <= 53
    assert 48 <= counts["r"] <= 53
    assert 48 <= counts["O"] <= 53
    assert 5 <= counts["x"] <= 6
    assert counts["o"] == 0


def test_inputs_and_outputs_are_told_as_they_are(flight):
    flight.sticks(ailerons=1200, elevator=1700, rudder=1650, throttle=1300, aux1=LOW)
    flight.send("s")
    *inputs_us, valid = struct.unpack(">6HB", flight.newest("i").payload)
    assert inputs_us == pytest.approx([1200, 1700, 1300, 1650, 1000, 1000], abs=1)
    assert valid == 0x3F
    outputs_us = struct.unpack(">4H", flight.newest("r").payload)
    assert outputs_us == pytest.approx((1200, 1700, 1000, 1650), abs=1)
    assert flight.servo_us("ailerons") == pytest.approx(1200, abs=1)


def test_arm_and_disarm(flight):
    flight.run_ms(1500)
    assert flight.ask("a") == VETO
    flight.sticks(400, aux2=HIGH)
    if flight.status().is_armed:
        flight.sticks(2200)
        assert flight.ask("d") == "K"
        assert not flight.status().is_armed
    assert flight.ask("a") == "K"
    assert flight.status().is_armed


def test_arm_wants_a_low_throttle(flight):
    flight.run_ms(1500)
    flight.arm()
    flight.run_ms(2200)
    assert flight.ask("d") == "K"
    flight.sticks(throttle=1400)
    assert flight.ask("a") == THROTTLE
    assert not flight.status().is_armed


def test_disarm_wants_the_throttle_low_for_two_seconds(auto):
    auto.sticks(throttle=1500)
    assert auto.ask("d") == THROTTLE
    auto.sticks(1500, throttle=LOW)
    assert auto.ask("d") == THROTTLE
    auto.run_ms(700)
    assert auto.ask("d") == "K"
    assert not auto.status().is_armed


@pytest.mark.parametrize("letter", "rfsu")
def test_modes_are_taken_at_auto_only(auto, letter):
    assert auto.ask("M", letter.encode()) == "K"
    auto.sticks(aux1=MIDDLE)
    assert auto.ask("M", letter.encode()) == NOT_AT_AUTO
    assert auto.mode() == "f"


@pytest.mark.parametrize("letter", "ahAx\0")
def test_the_raspberry_cannot_ask_for_acro_nor_for_anything_else(auto, letter):
    assert auto.ask("M", letter.encode()) == OUT_OF_RANGE
    assert auto.mode() == "f"


@pytest.mark.parametrize(("panic", "delay_ms"), [(2, 50), (0, 9), (0, 1001), (1, -1)])
def test_panic_has_its_range(flight, panic, delay_ms):
    assert flight.ask("p", struct.pack(">Bh", panic, delay_ms)) == OUT_OF_RANGE


def test_panic_sets_the_period_of_what_is_forwarded(flight):
    flight.send("s")
    assert flight.ask("p", struct.pack(">Bh", 1, 150)) == "K"
    flight.run_ms(200)
    del flight.messages[:]
    flight.run_ms(1500)
    for letter in "irO":
        assert 9 <= sum(each.type == letter for each in flight.messages) <= 11
    assert flight.ask("p", struct.pack(">Bh", 0, 20)) == "K"
    del flight.messages[:]
    flight.run_ms(500)
    assert sum(each.type == "O" for each in flight.messages) >= 23


def test_panic_never_slows_what_the_raspberrys_controller_consumes(auto):
    assert auto.ask("p", struct.pack(">Bh", 1, 150)) == "K"
    assert auto.ask("M", b"u") == "K"
    for _ in range(20):
        auto.send("u", outputs(auto))
        auto.run_ms(10)
    assert auto.mode() == "u"
    del auto.messages[:]
    auto.send("u", outputs(auto))
    del auto.messages[:]
    auto.run_ms(200)
    assert sum(each.type == "O" for each in auto.messages) >= 9
    assert sum(each.type == "i" for each in auto.messages) >= 9
    assert sum(each.type == "r" for each in auto.messages) <= 2


def test_gains_of_three_axes_are_taken_whole(flight):
    assert flight.ask("g", gains(*GAINS)) == "K"
    assert flight.ask("G") == gains(*GAINS)
    assert flight.ask("T") == gains(*GAINS[0:6], *GAINS[9:15])


def test_gains_of_two_axes_leave_the_rudders(flight):
    assert flight.ask("g", gains(*GAINS)) == "K"
    assert flight.ask("t", gains(*range(12))) == "K"
    assert flight.ask("T") == gains(*range(12))
    assert flight.ask("G") == gains(*range(6), *GAINS[6:9], *range(6, 12), *GAINS[15:18])


@pytest.mark.parametrize("bad", [NAN, INFINITY, -INFINITY, -0.001, 50.01])
@pytest.mark.parametrize(("letter", "count"), [("g", 18), ("t", 12)])
def test_a_set_of_gains_with_one_bad_value_is_refused_whole(flight, letter, count, bad):
    before = flight.ask("G")
    for at in (0, count // 2, count - 1):
        values = [1.0] * count
        values[at] = bad
        assert flight.ask(letter, gains(*values)) == OUT_OF_RANGE
    assert flight.ask("G") == before


def test_gains_taken_disarmed_are_kept_and_those_of_a_flight_are_not(flight):
    flight.run_ms(1500)
    assert not flight.status().flags & GAINS_KEPT
    assert flight.ask("g", gains(*GAINS)) == "K"
    flight.run_ms(600)
    assert flight.status().flags & GAINS_KEPT
    flight.arm()
    assert flight.ask("g", gains(*reversed(GAINS))) == "K"
    assert flight.ask("G") == gains(*reversed(GAINS))
    flight.run_ms(600)
    again = Flight(eeprom=flight.rig.eeprom.read())
    assert again.ask("G") == gains(*GAINS)


def test_streams_are_not_acknowledged(flight):
    assert flight.ask("v", b"\0") is None


@pytest.mark.parametrize(("letter", "size"), [("h", 2), ("b", 2), ("B", 2), ("l", 8)])
def test_what_nothing_on_the_board_uses_is_refused(flight, letter, size):
    flight.run_ms(1200)
    assert flight.ask(letter, bytes(size)) == NOT_SUPPORTED


@pytest.mark.parametrize(
    ("letter", "payload"),
    [
        ("v", b"\2"),
        ("e", b"\4"),
        ("S", setpoint(lifetime_ms=251)),
        ("S", setpoint(lifetime_ms=0)),
        ("S", setpoint(throttle=999)),
        ("u", struct.pack(">5H", 999, 1500, 0, 1500, 0)),
        ("u", struct.pack(">5H", 1500, 1500, 2001, 1500, 0)),
    ],
)
def test_values_out_of_range_are_refused(flight, letter, payload):
    assert flight.ask(letter, payload) == OUT_OF_RANGE


def test_refusals_of_streams_come_once_a_second(flight):
    for _ in range(50):
        flight.send("v", b"\2")
        flight.run_ms(20)
    assert 1 <= sum(each.type == "!" for each in flight.messages) <= 2


def test_outputs_reach_the_servos_while_they_are_fresh(auto):
    assert auto.ask("M", b"u") == "K"
    auto.send("u", outputs(auto, 1234, 1765, 1450, 1610))
    auto.rig.servo.forget()
    auto.run_ms(60)
    widths = [auto.rig.servo.newest_us(each) for each in ("ailerons", "elevator", "rudder")]
    assert widths == pytest.approx([1234, 1765, 1610], abs=0.6)
    assert auto.rig.servo.newest_us("throttle") == pytest.approx(1450, abs=0.6)
    auto.run_ms(200)
    assert auto.servo_us("ailerons") == pytest.approx(1500, abs=5)
    assert auto.servo_us("throttle") == pytest.approx(1000, abs=1)
    auto.run_ms(200)
    assert auto.mode() == "f"


def test_an_output_of_an_old_orientation_is_refused(auto):
    assert auto.ask("M", b"u") == "K"
    sequence = auto.orientation_sequence()
    auto.run_ms(130)
    assert auto.ask("u", outputs(auto, sequence=sequence)) == TOO_OLD
    assert auto.ask("u", outputs(auto, sequence=(sequence + 5000) % 65536)) in (None, TOO_OLD)
    assert auto.mode() != "u" or auto.servo_us("ailerons") == pytest.approx(1500, abs=5)


def test_an_output_wants_the_switch_the_armed_aircraft_and_the_imu(auto):
    auto.rig.imu.unplug()
    auto.run_ms(150)
    assert auto.ask("u", struct.pack(">5H", 1500, 1500, 0, 1500, 0)) == IMU
    auto.rig.imu.plug()
    auto.run_ms(800)
    auto.sticks(1100, aux1=MIDDLE)
    assert auto.ask("u", outputs(auto)) == NOT_AT_AUTO


def test_an_output_to_a_disarmed_aircraft_is_refused(flight):
    flight.run_ms(1500)
    flight.sticks(aux1=HIGH)
    flight.send("s")
    assert flight.ask("u", outputs(flight)) == VETO


def test_a_setpoint_lives_as_long_as_it_says(auto):
    assert auto.ask("M", b"s") == "K"
    auto.send("S", setpoint(roll=3000, throttle=1600, lifetime_ms=200))
    auto.run_ms(100)
    assert auto.mode() == "s"
    assert auto.servo_us("ailerons", 60) > 1700
    auto.run_ms(150)
    assert auto.mode() == "f"
    assert auto.servo_us("ailerons") == pytest.approx(1500, abs=5)


def test_an_output_leaves_nothing_of_an_older_setpoint(auto):
    auto.send("S", setpoint(throttle=1200))
    auto.run_ms(30)
    auto.send("u", outputs(auto, 1900, 1900, 1100, 1900))
    auto.run_ms(30)
    assert auto.ask("M", b"s") == "K"
    auto.rig.servo.forget()
    auto.run_ms(150)
    for channel, most_us in (("throttle", 1001), ("ailerons", 1520), ("rudder", 1520)):
        assert max(each.width_us for each in auto.rig.servo.pulses(channel)[1:]) <= most_us


def test_a_veto_holds_off_arming_for_a_second(flight):
    flight.run_ms(1500)
    flight.send("v", b"\1")
    flight.sticks(400, aux2=HIGH)
    status = flight.status()
    assert status.vetoes & 16
    assert not status.flags & ARMED
    flight.run_ms(1100)
    assert flight.ask("a") == "K"


def test_the_profile_is_taken_told_and_kept(flight):
    profile = bytearray(flight.ask("c"))
    assert len(profile) == 54
    profile[30:33] = b"ffA"
    assert flight.ask("C", bytes(profile)) == "K"
    assert flight.ask("c") == bytes(profile)
    assert flight.mode() == "f"
    flight.run_ms(600)
    assert Flight(eeprom=flight.rig.eeprom.read()).ask("c") == bytes(profile)


@pytest.mark.parametrize(
    ("offset", "value"),
    [(0, 2), (1, 1), (3, 0), (28, 3), (29, 2), (30, ord("x")), (33, 0xFF), (43, 0), (53, 2)],
)
def test_a_profile_with_one_bad_field_is_refused_whole(flight, offset, value):
    before = flight.ask("c")
    profile = bytearray(before)
    profile[offset] = value
    assert flight.ask("C", bytes(profile)) == OUT_OF_RANGE
    assert flight.ask("c") == before


def test_profile_and_calibration_wait_for_the_disarmed_aircraft(auto):
    assert auto.ask("C", auto.ask("c")) == ONLY_ON_GROUND
    for what in range(4):
        assert auto.ask("e", bytes((what,))) == ONLY_ON_GROUND


def test_level_is_what_it_is_told_to_be(flight):
    flight.run_ms(1500)
    flight.tilt(5, -4)
    flight.run_ms(2500)
    assert flight.ask("e", b"\0") == "K"
    assert flight.attitude()[:2] == pytest.approx((0, 0), abs=0.5)
    flight.run_ms(600)
    again = Flight(eeprom=flight.rig.eeprom.read(), boots=False)
    again.rig.imu.motion = motion_at(5, -4)
    again.run_ms(2500)
    assert again.attitude()[:2] == pytest.approx((0, 0), abs=0.7)


def test_the_gyros_bias_wants_stillness(flight):
    flight.rig.imu.bias_deg_s = (2.0, -1.0, 0.5)
    flight.run_ms(2500)
    assert flight.ask("e", b"\3") == "K"
    assert flight.attitude()[3:] == pytest.approx((0, 0, 0), abs=0.3)
    flight.tilt(30, seconds=0.3)
    assert flight.ask("e", b"\3") == NOT_STILL


def test_a_receiver_with_other_end_points_is_learned(flight):
    flight.run_ms(1500)
    assert flight.ask("e", b"\2") == OUT_OF_RANGE
    assert flight.ask("e", b"\1") == "K"
    names = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
    for end in (1100, 1900, 1500):
        flight.sticks(100, **dict.fromkeys(names, end))
    assert flight.ask("e", b"\2") == "K"
    flight.sticks(100, ailerons=1900, elevator=1100, aux1=1100)
    assert flight.servo_us("ailerons") == pytest.approx(2000, abs=3)
    assert flight.servo_us("elevator") == pytest.approx(1000, abs=3)


@pytest.mark.parametrize("letter", "ZKrix")
def test_a_type_that_is_none_is_refused_by_name(flight, letter):
    assert flight.ask(letter) == 1


def test_a_payload_of_the_wrong_size_is_refused(flight):
    assert flight.ask("M") == 2
    assert flight.ask("s", b"\0") == 2
