"""Control authority: the pilot's switch, and the limits of the Raspberry Pi."""

import pytest

from tests.arduino.commands import outputs, setpoint
from tests.arduino.flight import AUTO, FRAME_US, HIGH, LOW, MIDDLE

ONE_FRAME_US = FRAME_US + 6_000
"""A frame of the receiver, and the constant 5 ms from its pulse to the servo's."""


@pytest.fixture
def armed(shared_armed):
    """Return an armed aircraft, level, sticks centred, the switch at ACRO, without requests."""
    flight = shared_armed
    flight.rig.receiver.start()
    flight.tilt(0, seconds=0.2)
    flight.sticks(ailerons=1500, elevator=1500, rudder=1500, throttle=LOW, aux1=LOW, aux2=HIGH)
    assert flight.status().is_armed
    return flight


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
    auto.rig.servo.clear()
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
        late = auto.widths_us(channel, moved + ONE_FRAME_US * 16)
        assert len(late) >= 8
        if channel == "throttle":
            assert late == pytest.approx([1000] * len(late), abs=1)
        elif to == LOW:
            assert late == pytest.approx([1400] * len(late), abs=1)
        else:
            assert max(late) < 1500


def test_the_raspberry_lost_at_auto_leaves_fbw_within_the_lifetime(auto):
    auto.sticks(throttle=1300)
    stream(auto, 200, lambda: [("S", setpoint(roll=4500, throttle=1700))])
    sent = auto.rig.cycle
    assert auto.mode() == "s"
    auto.rig.servo.clear()
    auto.run_ms(500)
    ends = sent + (250_000 + ONE_FRAME_US) * 16
    after = auto.widths_us("ailerons", ends)
    assert after and max(after) < 1520
    throttles = auto.widths_us("throttle", ends)
    assert throttles == pytest.approx([1300] * len(throttles), abs=1)
    assert auto.mode() == "f"
    assert auto.status().is_armed
