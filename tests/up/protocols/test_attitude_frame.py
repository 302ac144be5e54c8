"""Attitude frames: what a reader makes of them, when they stand for a frame, and bad ones."""

import json
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.protocols.attitude_frame import Expander, is_attitude, shorten
from up.protocols.packed_dictionary import DICTIONARY
from up.protocols.packed_telemetry import PackedError, Packer, Unpacker

WHOLE_S = 4.0
ANGLES = st.fixed_dictionaries(dict.fromkeys(("roll", "pitch", "yaw"), st.floats(-360, 360)))
VOLTS = st.none() | st.floats(0, 66)


def frame(beacon=100, clock_ms=5000, **more):
    content = {
        "orientation": {"roll": 1.5, "pitch": -2.0, "yaw": 270.1},
        "rates": {"roll": 0.5, "pitch": 1.0, "yaw": 2.0},
        "armed": True,
        "arduino": {"switch": "AUTO", "loop_us": 2000, "flight_battery_v": 11.42},
        "location": {"latitude": 50.1},
        "uplink": {"left_out": 7},
        "system": {"clock_ms": clock_ms},
        "age_ms": {"orientation": 0, "flight": 150, "location": 300, "battery": None},
        **more,
    }
    message = {"name": "up.telemetry.update", "data": content, "id": None, "beacon": beacon}
    return json.dumps(message).encode("ascii")


def read(key, new):
    found = shorten(key, new)
    return None if found is None else json.loads(Expander(key).expand(found[0]))


@given(ANGLES, st.integers(0, 255), st.integers(0, 65535), st.integers(0, 14), VOLTS, VOLTS)
def test_attitude_is_new_and_everything_else_has_its_true_age(
    angles, steps, clock_ms, age, before_v, after_v
):
    key = frame(arduino={"loop_us": 2000, "flight_battery_v": before_v})
    new = frame(
        100 + steps,
        5000 + clock_ms,
        orientation=angles,
        arduino={"loop_us": 2001, "flight_battery_v": after_v},
        age_ms={"orientation": 150 * age, "flight": None, "location": 0, "battery": 0},
        location={"latitude": 51.0},
    )
    seen = read(key, new)
    is_far = (before_v is None) is not (after_v is None) or (
        before_v is not None and abs(after_v - before_v) > 6.4
    )
    if seen is None:
        assert is_far or abs(after_v - before_v) > 6.3
        return
    assert not is_far
    content = seen["data"]
    assert seen["beacon"] == 100 + steps
    assert content["system"]["clock_ms"] == 5000 + clock_ms
    assert content["orientation"] == pytest.approx(angles, abs=0.051)
    assert content["arduino"]["flight_battery_v"] == (after_v and pytest.approx(after_v, abs=0.026))
    assert content["age_ms"] == {
        "orientation": 150 * age,
        "flight": None,
        "location": 300 + clock_ms,
        "battery": None,
    }
    assert content["location"] == {"latitude": 50.1}
    # They have the age of the attitude, and are not known.
    assert content["rates"] == {"roll": None, "pitch": None, "yaw": None}
    assert content["arduino"]["loop_us"] is None


@pytest.mark.parametrize(
    "more",
    [
        {"beacon": 356},
        {"beacon": 99},
        {"clock_ms": 5000 + 65536},
        {"orientation": None},
        {"orientation": {"roll": 1.0, "pitch": None, "yaw": 0.0}},
        {"uplink": {"left_out": 6}},
        {"age_ms": {"orientation": 3000, "flight": 0}},
        {"age_ms": {"orientation": 0, "flight": 3000}},
    ],
)
def test_what_has_no_place_needs_a_whole_frame(more):
    assert shorten(frame(), frame()) is not None
    assert shorten(frame(), frame(**more)) is None


def test_they_stand_for_frames_until_the_key_is_old_or_they_do_not_suffice():
    packer, unpacker = Packer(), Unpacker()

    def is_sent_short(number, now_s, **more):
        new = frame(100 + number, 5000 + round(1000 * now_s), **more)
        body = packer.pack(new, now_s, WHOLE_S, lambda a, b: a["armed"] == b["armed"])
        assert json.loads(unpacker.unpack(body))["beacon"] == 100 + number
        assert is_attitude(body) is (len(body) == 17)
        return is_attitude(body)

    assert not is_sent_short(0, 0.0)
    assert is_sent_short(1, 0.1)
    assert is_sent_short(2, WHOLE_S - 0.1)
    assert not is_sent_short(3, WHOLE_S)
    assert not is_sent_short(4, WHOLE_S + 0.1, armed=False)
    # The frame before is the key, however young.
    assert is_sent_short(5, WHOLE_S + 0.2, armed=False)
    packer.restart()
    assert not is_sent_short(6, WHOLE_S + 0.3, armed=False)
    assert not is_attitude(packer.pack(frame(107), WHOLE_S + 0.4))


@given(st.binary(max_size=20), st.sampled_from([DICTIONARY, frame(), b"{", b'{"name":"a"}']))
def test_any_data_of_any_key_are_read_or_refused(data, key):
    reader = Expander(key)
    for each in (data, b"\x07" + data[:12].ljust(12, b"\0")):
        with suppress(ValueError):
            assert json.loads(reader.expand(each))["name"] == "up.telemetry.update"


def test_a_wrong_one_is_a_refused_frame():
    unpacker, packer = Unpacker(), Packer()
    key = packer.pack(frame(), 0.0)
    unpacker.unpack(key)
    short = packer.pack(frame(101), 0.1, WHOLE_S, lambda a, b: True)
    unpacker.unpack(short)
    for bad in (short[:-1], short + b"\0", short[:4] + b"\x0f" + short[5:]):
        with pytest.raises(PackedError):
            unpacker.unpack(bad)
