"""The messages, against recorded answers, and against any bytes."""

import struct
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msp_cog import messages
from msp_cog.messages import UnfitError
from msp_cog.stick_curve import StickCurve

from tests.cogs.msp_cog.recorded import ANGLE, ANSWERS, ARMED, OVERRIDE, status
from up.commands.flight_state_command import FlightBatteryCommand

BOX_IDS = ANSWERS[messages.BOX_IDS]
READERS = [
    messages.read_attitude,
    messages.read_rates,
    messages.read_channels,
    messages.read_voltage,
    messages.read_fix,
    messages.read_surfaces,
    messages.read_motor,
    lambda payload: messages.read_status(payload, BOX_IDS),
    lambda payload: messages.read_curves({**ANSWERS, messages.RC_TUNING: payload}),
    lambda payload: messages.read_curves({**ANSWERS, messages.ADVANCED: payload}),
]


def test_the_status_names_active_modes_and_reasons():
    found = messages.read_status(status(ARMED | ANGLE | OVERRIDE, 1 << 9 | 1 << 16), BOX_IDS)
    assert found.boxes == {messages.BOX_ARM, messages.BOX_ANGLE, messages.BOX_OVERRIDE}
    assert found.reasons == ["boot_grace_time", "msp"] and not found.is_failsafe
    # The switch of the failsafe is a mode, too: bit 7 of this board.
    assert messages.read_status(status(1 << 7), BOX_IDS).is_failsafe


def test_a_status_with_modes_beyond_the_first_32():
    plain = status()
    long = plain[:15] + b"\x01\x02" + plain[16:]
    found = messages.read_status(long, bytes(range(40)))
    assert found.boxes == {1, 33} and found.arming_disabled == 0


def test_the_curves_are_those_of_the_settings():
    curve = StickCurve(limit_deg=60, centre=7, full=67, expo=0, dead_us=0)
    assert messages.read_curves(ANSWERS) == (curve, curve)
    tuning = bytearray(ANSWERS[messages.RC_TUNING])
    # As msp.c writes them: centre and expo of roll first, those of pitch after yaw's.
    tuning[0:4], tuning[12:14] = b"\x0a\x14\x32\x3c", b"\x0b\x1e"
    settings = {**ANSWERS, messages.RC_TUNING: bytes(tuning), messages.DEADBAND: b"\x05"}
    assert messages.read_curves(settings) == (
        StickCurve(60, 10, 50, 20, 5),
        StickCurve(60, 11, 60, 30, 5),
    )


def test_no_fix_and_no_voltage():
    assert messages.read_fix(bytes(18)) is None
    assert messages.read_voltage(bytes(9)) is None
    assert messages.read_voltage(bytes(7) + b"\x64\x04") == FlightBatteryCommand(11.24)


@pytest.mark.parametrize("read", READERS)
@given(payload=st.binary(max_size=64))
def test_any_payload_is_read_or_refused(read, payload):
    with suppress(struct.error, ValueError, IndexError, UnfitError):
        read(payload)


@given(
    curve=st.builds(
        StickCurve,
        limit_deg=st.integers(10, 80),
        centre=st.integers(1, 100),
        full=st.integers(1, 200),
        expo=st.integers(0, 100),
        dead_us=st.integers(0, 32),
    ),
    angle_deg=st.floats(-90, 90),
)
def test_the_stick_is_the_inverse_of_the_boards_curve(curve, angle_deg):
    stick_us = curve.stick_us(angle_deg)
    assert 1000 <= stick_us <= 2000
    wanted = min(abs(angle_deg), curve.limit_deg)
    beyond = max(0.0, abs(stick_us - 1500) - curve.dead_us) / (500 - curve.dead_us)
    step = max(0.0, beyond - 1.01 / (500 - curve.dead_us)), beyond + 1.01 / (500 - curve.dead_us)
    low, high = (curve.angle_deg(min(1.0, each)) for each in step)
    assert low - 1e-6 <= wanted <= high + 1e-6
    assert stick_us == 1500 or (stick_us > 1500) == (angle_deg > 0)


def test_points_of_the_curve():
    """7 x + 60 x^2 is half of 67 at x = 0.691."""
    assert StickCurve(60, 7, 67, 0).stick_us(30.0) == 1846
    assert StickCurve(60, 7, 67, 0).stick_us(-60.0) == 1000
