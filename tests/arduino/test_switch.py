"""Control authority: the pilot's switch, and the limits of the Raspberry Pi."""

import pytest

from tests.arduino.commands import outputs, profile, setpoint
from tests.arduino.flight import AUTO, FRAME_US, HEARD, HIGH, LOW, MIDDLE, Flight

ONE_FRAME_US = FRAME_US + 6_000
"""A frame of the receiver, and the constant 5 ms from its pulse to the servo's."""


@pytest.fixture(scope="module")
def shared():
    flight = Flight()
    flight.run_ms(1500)
    flight.arm()
    flight.send("s")
    return flight


@pytest.fixture
def armed(shared):
    """Return an armed aircraft, level, sticks centred, the switch at ACRO, without requests."""
    shared.rig.receiver.start()
    shared.tilt(0, seconds=0.2)
    shared.sticks(ailerons=1500, elevator=1500, rudder=1500, throttle=LOW, aux1=LOW, aux2=HIGH)
    assert shared.status().is_armed
    return shared


@pytest.fixture
def auto(armed):
    armed.sticks(aux1=HIGH)
    return armed


def stream(flight, duration_ms, make):
    """Send what ``make`` returns every 20 ms, as the Raspberry Pi does."""
    for _ in range(duration_ms // 20):
        for letter, payload in make():
            flight.send(letter, payload)
        flight.run_ms(20)


def test_low_is_acro_middle_is_fbw_and_high_is_auto(armed):
    armed.tilt(30)
    assert (armed.mode(), armed.status().switch) == ("a", 0)
    assert armed.servo_us("ailerons") == pytest.approx(1500, abs=1)
    armed.sticks(aux1=MIDDLE)
    assert (armed.mode(), armed.status().switch) == ("f", 1)
    assert armed.servo_us("ailerons") < 1300
    assert not armed.status().flags & AUTO
    armed.sticks(aux1=HIGH)
    status = armed.status()
    assert (status.mode_letter, status.switch, status.flags & AUTO) == ("f", 2, AUTO)
    assert armed.servo_us("ailerons") < 1300


def test_each_position_selects_what_the_profile_says():
    flight = Flight()
    flight.run_ms(1300)
    assert flight.ask("C", profile(switch=b"Afr")) == "K"
    flight.tilt(30)
    assert flight.status().flags & AUTO
    flight.sticks(aux1=MIDDLE)
    assert flight.mode() == "f"
    flight.sticks(aux1=HIGH)
    assert flight.mode() == "r"
    # At rest, and no rate requested: RATE does not level.
    assert flight.servo_us("ailerons") == pytest.approx(1500, abs=5)


@pytest.mark.parametrize("to", [LOW, MIDDLE])
@pytest.mark.parametrize("what", ["outputs", "setpoint"])
def test_leaving_auto_takes_over_within_a_frame_whatever_the_raspberry_sends(auto, to, what):
    is_output = what == "outputs"
    assert auto.ask("M", b"u" if is_output else b"s") == "K"

    def demand():
        if is_output:
            return [("M", b"u"), ("u", outputs(auto, 1900, 1500, 1700))]
        return [("M", b"s"), ("S", setpoint(roll=4500, throttle=1700))]

    stream(auto, 200, demand)
    assert auto.servo_us("ailerons") > 1700
    assert auto.servo_us("throttle") == pytest.approx(1700, abs=1)
    auto.rig.servo.forget()
    del auto.rig.receiver.sent[:]
    auto.rig.receiver.sticks(ailerons=1400, aux1=to)
    # Not a word of what it sends is waited for.
    stream(auto, 300, demand)
    moved = next(
        each.rise_cycle + each.width_cycles
        for each in auto.rig.receiver.sent
        if each.channel == "aux1" and each.width_cycles < 1700 * 16
    )
    for channel in ("ailerons", "throttle"):
        late = [
            each.width_us
            for each in auto.rig.servo.pulses(channel)
            if each.rise_cycle >= moved + ONE_FRAME_US * 16
        ]
        assert len(late) >= 8
        if channel == "throttle":
            assert late == pytest.approx([1000] * len(late), abs=1)
        elif to == LOW:
            assert late == pytest.approx([1400] * len(late), abs=1)
        else:
            assert max(late) < 1500


def test_a_receiver_that_comes_back_is_not_a_switch_that_moved(auto):
    assert auto.ask("M", b"r") == "K"
    assert auto.mode() == "r"
    auto.rig.receiver.stop()
    auto.run_ms(900)
    assert auto.status().is_failsafe
    auto.rig.receiver.start()
    auto.run_ms(150)
    status = auto.status()
    assert not status.is_failsafe
    assert (status.mode_letter, status.switch) == ("r", 2)
    assert status.is_armed


def test_what_was_asked_ends_with_auto(auto):
    assert auto.ask("M", b"r") == "K"
    auto.sticks(aux1=MIDDLE)
    auto.sticks(aux1=HIGH)
    assert auto.mode() == "f"


def test_the_throttle_is_the_sticks_without_a_demand_at_auto(auto):
    auto.sticks(throttle=1350)
    assert auto.servo_us("throttle") == pytest.approx(1350, abs=1)
    stream(auto, 200, lambda: [("S", setpoint(roll=1000))])
    assert auto.mode() == "s"
    assert auto.servo_us("throttle") == pytest.approx(1350, abs=1)
    stream(auto, 200, lambda: [("S", setpoint(roll=1000, throttle=1600))])
    assert auto.servo_us("throttle", 40) == pytest.approx(1600, abs=1)
    auto.run_ms(300)
    assert auto.servo_us("throttle") == pytest.approx(1350, abs=1)


def test_the_raspberry_lost_at_auto_leaves_fbw_within_the_lifetime(auto):
    auto.sticks(throttle=1300)
    stream(auto, 200, lambda: [("S", setpoint(roll=4500, throttle=1700))])
    sent = auto.rig.cycle
    assert auto.mode() == "s"
    auto.rig.servo.forget()
    auto.run_ms(500)
    ends = sent + (250_000 + ONE_FRAME_US) * 16
    after = [each.width_us for each in auto.rig.servo.pulses("ailerons") if each.rise_cycle > ends]
    assert after and max(after) < 1520
    throttles = [
        each.width_us for each in auto.rig.servo.pulses("throttle") if each.rise_cycle > ends
    ]
    assert throttles == pytest.approx([1300] * len(throttles), abs=1)
    assert auto.mode() == "f"
    assert auto.status().is_armed


@pytest.mark.parametrize("lifetime_ms", [1, 20, 100, 250])
def test_no_setpoint_lives_longer_than_it_says(auto, lifetime_ms):
    auto.send("S", setpoint(roll=4500, lifetime_ms=lifetime_ms))
    sent = auto.rig.cycle
    auto.rig.servo.forget()
    auto.run_ms(lifetime_ms + 100)
    ends = sent + (lifetime_ms * 1000 + 3_000 + ONE_FRAME_US) * 16
    pulses = auto.rig.servo.pulses("ailerons")
    if lifetime_ms >= 100:
        assert max(each.width_us for each in pulses) > 1700
    assert all(each.width_us < 1520 for each in pulses if each.rise_cycle > ends)


def test_an_output_ends_after_its_250_ms(auto):
    assert auto.ask("M", b"u") == "K"
    stream(auto, 100, lambda: [("u", outputs(auto, 1900))])
    sent = auto.rig.cycle
    auto.rig.servo.forget()
    auto.run_ms(400)
    pulses = auto.rig.servo.pulses("ailerons")
    ends = sent + (250_000 + ONE_FRAME_US) * 16
    assert pulses[0].width_us == pytest.approx(1900, abs=1)
    assert all(each.width_us < 1520 for each in pulses if each.rise_cycle > ends)


def test_an_output_is_taken_from_a_fresh_orientation_only(auto):
    assert auto.ask("M", b"u") == "K"
    sequence = auto.orientation_sequence()
    auto.run_ms(60)
    auto.send("u", outputs(auto, 1900, sequence=sequence))
    assert auto.servo_us("ailerons") == pytest.approx(1900, abs=1)
    auto.run_ms(400)
    sequence = auto.orientation_sequence()
    auto.run_ms(105)
    auto.send("u", outputs(auto, 1900, sequence=sequence))
    assert auto.servo_us("ailerons") < 1520


@pytest.mark.parametrize("position", [LOW, MIDDLE])
def test_the_raspberry_lost_away_from_auto_is_a_flag_and_nothing_else(armed, position):
    armed.sticks(aux1=position, ailerons=1600, throttle=1450)
    stream(armed, 200, lambda: [("v", b"\0")])
    before = armed.status()
    assert before.flags & HEARD
    surfaces = [armed.servo_us(each) for each in ("ailerons", "throttle")]
    armed.run_ms(1500)
    assert [armed.servo_us(each) for each in ("ailerons", "throttle")] == pytest.approx(
        surfaces, abs=3
    )
    armed.messages.clear()
    armed.run_ms(300)
    statuses = [each for each in armed.messages if each.type == "x"]
    assert statuses and not statuses[-1].payload[3] & HEARD
    after = armed.status()
    assert (after.mode, after.is_armed, after.is_failsafe) == (before.mode, True, False)


@pytest.mark.parametrize("position", [LOW, MIDDLE])
def test_nothing_of_the_raspberry_flies_away_from_auto(armed, position):
    armed.sticks(aux1=position)
    before = armed.servo_us("ailerons")
    stream(
        armed,
        300,
        lambda: [
            ("M", b"u"),
            ("u", outputs(armed, 1900, 1900, 1900, 1900)),
            ("M", b"s"),
            ("S", setpoint(4000, 2000, 0, 1900)),
        ],
    )
    assert armed.servo_us("ailerons", 40) == pytest.approx(before, abs=3)
    assert armed.servo_us("throttle", 40) == pytest.approx(1000, abs=1)
