"""The profile of the airframe."""

from dataclasses import replace

import pytest
from arduino_cog.profile import PROFILE_SIZE, Channel, Profile, pack_profile, read_profile
from hypothesis import given
from hypothesis import strategies as st

CHANNEL = Channel(False, 0, 1000, 2000)
GLIDER = Profile(
    ailerons=CHANNEL, elevator=CHANNEL, throttle=CHANNEL, rudder=CHANNEL,
    mix="V-tail", has_motor=False, switch=("ACRO", "RATE", "AUTO"),
    roll_limit_deg=50.0, pitch_up_limit_deg=20.0, pitch_down_limit_deg=25.0,
    glide_pitch_deg=-3.5, circle_bank_deg=-20.0,
    throttle_failsafe_us=1000, throttle_lost_us=900,
    preset_ailerons_us=1500, preset_elevator_us=1501, preset_rudder_us=1502,
    may_return_with_motor=True,
)  # fmt: skip


def test_a_profile_comes_back():
    assert len(pack_profile(GLIDER)) == PROFILE_SIZE == 54
    assert read_profile(pack_profile(GLIDER)) == GLIDER


@pytest.mark.parametrize(
    "change",
    [
        {"ailerons": replace(CHANNEL, trim_us=201)},
        {"rudder": replace(CHANNEL, lowest_us=2000)},
        {"throttle": replace(CHANNEL, highest_us=2201)},
        {"mix": "delta"},
        {"switch": ("ACRO", "RTH", "AUTO")},
        {"roll_limit_deg": 91.0},
        {"pitch_up_limit_deg": -1.0},
        {"glide_pitch_deg": float("nan")},
    ],
)
def test_what_is_out_of_range_is_never_packed(change):
    with pytest.raises(ValueError):
        pack_profile(replace(GLIDER, **change))


@given(st.binary(min_size=54, max_size=54))
def test_any_54_bytes_are_read_or_refused(payload):
    try:
        read_profile(payload)
    except ValueError as error:
        assert "not known" in str(error)
