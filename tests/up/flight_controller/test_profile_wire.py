import struct
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.cogs.arduino_cog.board import PROFILE, PROFILE_FORMAT
from up.config import ConfigErrors
from up.config.schema import plain_value
from up.flight_controller.airframe_profile import AirframeProfile
from up.flight_controller.profile_wire import (
    AIRFRAME,
    differences,
    flat,
    nested,
    pack_profile,
    read_profile,
)

FACTORY = read_profile(struct.pack(PROFILE_FORMAT, *PROFILE))
PATH = Path("config/airframe.yml")


def wishes(text):
    return dict(flat(plain_value(AIRFRAME.schema, AIRFRAME.parse(text, PATH))))


def test_the_shipped_file_asks_for_nothing():
    assert AIRFRAME.parse(AIRFRAME.template(), PATH) == AirframeProfile()
    assert wishes(AIRFRAME.template()) == {}


def test_every_key_has_a_place_in_the_profile_and_the_other_way_round():
    keys = set()

    def walk(shape, above=""):
        for entry in shape.entries:
            if hasattr(entry.spec, "entries"):
                walk(entry.spec, f"{above}{entry.name}.")
            else:
                keys.add(above + entry.name)

    walk(AIRFRAME.schema)
    assert keys == dict(flat(nested(FACTORY))).keys()


def test_a_profile_that_was_told_can_be_written_into_the_file():
    data = nested(FACTORY)
    assert dict(flat(data)) == FACTORY
    lines = []
    for name, value in data.items():
        if isinstance(value, dict):
            lines += [f"{name}:", *(f"  {key}: {each}" for key, each in value.items())]
        else:
            lines.append(f"{name}: {value}")
    text = "\n".join(lines).replace("True", "true").replace("False", "false")
    assert {**FACTORY, **wishes(text)} == FACTORY


def test_only_what_is_said_changes():
    said = wishes(
        "rudder: {reversed: true, trim_us: -20}\nmix: V-tail\nswitch: {low: fbw}\n"
        "receiver_lost: {glide_pitch_deg: -2.5}\n"
    )
    assert differences(FACTORY, {**FACTORY, **said}) == [
        "rudder.reversed false, wanted true",
        "rudder.trim_us 0, wanted -20",
        "mix none, wanted V-tail",
        "switch.low ACRO, wanted FBW",
        "receiver_lost.glide_pitch_deg -3.0, wanted -2.5",
    ]


@pytest.mark.parametrize(
    ("text", "place", "sentence"),
    [
        ("ailerons: {trim: 5}", "1:12", "unknown key"),
        ("ailerons: {trim: 5}", "1:12", "did you mean 'trim_us'?"),
        ("rudder:\n  trim_us: 201", "2:12", "rudder.trim_us: must be a whole number between -200"),
        ("rudder:\n  lowest_us: 1500\n  highest_us: 1500", "3:15", "must be above lowest_us"),
        ("mix: delta", "1:6", "mix: must be one of"),
        ("switch: {high: RTH}", "1:16", "switch.high: must be one of"),
        ("fly_by_wire: {roll_deg: -1}", "1:25", "between 0 and 90 deg"),
        ("fly_by_wire: {roll_deg: .nan}", "1:25", "fly_by_wire.roll_deg: must be"),
        ("motor: maybe", "1:8", "motor: must be true or false"),
    ],
)
def test_mistakes_are_told_with_their_place(text, place, sentence):
    with pytest.raises(ConfigErrors) as caught:
        AIRFRAME.parse(text, PATH)
    (problem,) = caught.value.problems
    assert str(problem).startswith(f"{PATH}:{place}: ")
    assert sentence in str(problem)


@given(
    st.fixed_dictionaries(
        {},
        optional={
            "elevator.trim_us": st.integers(-200, 200),
            "throttle.highest_us": st.integers(1001, 2200),
            "fly_by_wire.roll_deg": st.floats(0, 90),
            "receiver_lost.circle_bank_deg": st.floats(-90, 90),
            "mix": st.sampled_from(["none", "elevon", "V-tail"]),
            "motor": st.booleans(),
        },
    )
)
def test_what_is_asked_for_is_found_in_what_is_read_back(changes):
    sent = pack_profile({**FACTORY, **changes})
    current = read_profile(sent)
    assert pack_profile({**current, **changes}) == sent


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("ailerons.trim_us", 201),
        ("rudder.highest_us", 1000),
        ("throttle.highest_us", 2201),
        ("mix", "delta"),
        ("switch.middle", "RTH"),
        ("fly_by_wire.roll_deg", 91.0),
        ("fly_by_wire.pitch_up_deg", -1.0),
        ("receiver_lost.glide_pitch_deg", float("nan")),
    ],
)
def test_a_value_out_of_range_is_never_packed(key, value):
    with pytest.raises(ValueError, match=key):
        pack_profile({**FACTORY, key: value})


@given(st.binary(min_size=54, max_size=54))
def test_any_bytes_are_read_or_refused_by_name(payload):
    try:
        profile = read_profile(payload)
    except ValueError as error:
        assert str(error).partition(":")[0] in {"mix", "switch.low", "switch.middle", "switch.high"}
    else:
        assert profile.keys() == FACTORY.keys()


@pytest.mark.parametrize(
    ("percent_s", "may_fly", "with_motor", "byte"),
    [
        (0, False, False, 0),
        (0, True, False, 2),
        (1, False, True, 5),
        (100, True, True, 83),
        (315, False, False, 252),
    ],
)
def test_the_last_byte_holds_what_the_pi_may_do_and_the_slew_limit(
    percent_s, may_fly, with_motor, byte
):
    wanted = {
        **FACTORY,
        "receiver_lost.pi_may_fly": may_fly,
        "receiver_lost.return_with_motor": with_motor,
        "throttle_slew_percent_s": percent_s,
    }
    payload = pack_profile(wanted)
    assert payload[-1] == byte
    held = -(-percent_s // 5) * 5
    assert read_profile(payload) == {**wanted, "throttle_slew_percent_s": held}
