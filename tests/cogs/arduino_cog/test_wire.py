"""Payloads against the golden vectors, both framings."""

import dataclasses
import json
import math
import struct
from pathlib import Path

import pytest
from arduino_cog import wire
from arduino_cog.commands.arduino_status_command import read_status
from hypothesis import given
from hypothesis import strategies as st

from up.commands.board_status import flight_mode_name, refusal_name
from up.flight_controller.gains_wire import pack_gains, read_gains
from up.flight_controller.profile_wire import pack_profile, read_profile

VECTORS = Path(__file__).parents[2] / "vectors"
ALL = [
    vector
    for name in ("serial_checked.json", "serial_thesis.json")
    for vector in json.loads((VECTORS / name).read_text())["vectors"]
]
TO_ARDUINO = [each for each in ALL if each["direction"] == "to_arduino" and each["payload"]]
FROM_ARDUINO = [each for each in ALL if each["direction"] == "from_arduino" and each["payload"]]


def name(vector):
    return f"{vector['type']} {vector['payload'][:12]}"


def flat(gains):
    return [g for loop in (gains.rate, gains.stabilize) for axis in loop.axes for g in axis]


def build(type_, fields):
    """Return the payload that the cog would send for a vector's fields."""
    match type_:
        case "p":
            return wire.pack_panic(fields["panic"], fields["delay_ms"])
        case "h":
            return wire.pack_altitude(fields["altitude_m"])
        case "b" | "B":
            return wire.pack_heading(fields["heading_deg"])
        case "l":
            return wire.pack_location(fields["latitude_deg"], fields["longitude_deg"])
        case "u":
            return wire.OUTPUT.pack(*fields.values())
        case "S" | "R":
            roll, pitch, yaw_rate, throttle, lifetime = fields.values()
            return wire.pack_setpoint(
                roll / 100, pitch / 100, yaw_rate / 100, throttle or None, lifetime
            )
        case "A":
            return wire.pack_airspeed(fields["airspeed_cm_s"] / 100)
        case "t" | "g":
            payload = struct.pack(f">{len(fields['gains'])}f", *fields["gains"])
            return pack_gains(read_gains(payload))
        case "C":
            return pack_profile(read_profile(bytes.fromhex(fields["profile"])))
        case "M":
            return fields["mode"].encode()
        case "v":
            return bytes((fields["veto"],))
        case "e":
            return bytes((fields["what"],))
        case "V":
            return wire.pack_voltage(fields["voltage_v"])
    raise AssertionError(type_)


@pytest.mark.parametrize("vector", TO_ARDUINO, ids=name)
def test_what_is_sent_is_the_vector(vector):
    assert build(vector["type"], vector["fields"]).hex() == vector["payload"]


@pytest.mark.parametrize("vector", FROM_ARDUINO, ids=name)
def test_what_comes_means_the_vector(vector):
    payload, fields = bytes.fromhex(vector["payload"]), vector["fields"]
    match vector["type"]:
        case "r":
            assert list(wire.OUTPUTS.unpack(payload)) == fields["outputs_us"]
        case "i":
            assert list(wire.INPUTS.unpack(payload)) == [*fields["inputs_us"], fields["valid"]]
        case "o":
            assert list(wire.ATTITUDE.unpack(payload)) == list(fields.values())
        case "O":
            assert list(wire.ORIENTATION.unpack(payload)) == list(fields.values())
        case "x":
            status = read_status(payload)
            expected = {**fields, "mode": ord(fields["mode"])}
            assert {key: getattr(status, key) for key in expected} == expected
        case "K":
            assert payload == bytes((ord(fields["type"]), fields["sequence"]))
        case "!":
            assert refusal_name(payload[2]) == "throttle_not_low"
        case "m":
            assert flight_mode_name(payload[0]) == "FBW"
        case "T" | "G":
            assert flat(read_gains(payload)) == fields["gains"]
        case "C":
            assert pack_profile(read_profile(payload)) == payload
        case other:
            raise AssertionError(other)


def test_every_type_with_a_payload_has_a_vector():
    assert {each["type"] for each in TO_ARDUINO} == set("MptghbBluSRAvCeV")
    assert {each["type"] for each in FROM_ARDUINO} == set("rioOxK!mTGC")


def test_the_vectors_profile_reads_as_the_page_says():
    vector = next(each for each in FROM_ARDUINO if each["type"] == "C")
    profile = read_profile(bytes.fromhex(vector["payload"]))
    expected = {
        **{"elevator.reversed": True, "elevator.trim_us": -20, "elevator.lowest_us": 1100},
        **{"elevator.highest_us": 1900, "switch.low": "ACRO", "switch.high": "AUTO"},
        **{"fly_by_wire.roll_deg": 50.0, "receiver_lost.glide_pitch_deg": -3.0},
    }
    assert profile.items() >= expected.items()


def test_the_status_says_what_its_bits_mean():
    vector = next(each for each in FROM_ARDUINO if each["type"] == "x")
    status = read_status(bytes.fromhex(vector["payload"]))
    assert status.is_armed
    assert not status.is_at_auto
    assert not status.is_failsafe
    assert status.is_gains_stored
    assert status.veto_names == ("AUX2 is low",)
    assert status.reset_causes == "power-on"


def test_an_older_status_lacks_fields_and_a_newer_one_has_more():
    payload = bytes.fromhex(next(each for each in FROM_ARDUINO if each["type"] == "x")["payload"])
    status = read_status(payload)
    assert read_status(payload[:20]) == dataclasses.replace(status, battery_mv=0, acceleration=0)
    assert read_status(payload + b"\1\2\3") == status


@pytest.mark.parametrize("voltage_v", [-0.1, 65.6, math.nan])
def test_a_voltage_beyond_the_wire_is_refused(voltage_v):
    with pytest.raises(ValueError):
        wire.pack_voltage(voltage_v)


@pytest.mark.parametrize(
    ("altitude_m", "sent"),
    [
        (0.5, 1),
        (1.5, 2),
        (2.5, 3),
        (-0.5, 0),
        (-1.5, -1),
        (299.7, 300),
        (4e4, 32767),
        (-4e4, -32768),
    ],
)
def test_altitudes_round_half_up_and_stay_within_16_bits(altitude_m, sent):
    assert wire.pack_altitude(altitude_m) == struct.pack(">h", sent)


@pytest.mark.parametrize(
    ("heading_deg", "sent"),
    [(90.6, 91), (90.5, 91), (91.5, 92), (359.4, 359), (359.5, 0), (-45, 315), (720, 0), (-0.4, 0)],
)
def test_headings_are_0_to_359(heading_deg, sent):
    assert wire.pack_heading(heading_deg) == struct.pack(">h", sent)


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e6, max_value=1e6))
def test_no_heading_leaves_the_circle(heading_deg):
    assert 0 <= struct.unpack(">h", wire.pack_heading(heading_deg))[0] <= 359


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_never_packed(bad):
    for pack in (
        wire.pack_altitude,
        wire.pack_heading,
        lambda value: wire.pack_location(value, 0.0),
        lambda value: wire.pack_location(0.0, value),
        lambda value: wire.pack_setpoint(value, 0, 0, None, 250),
        lambda value: wire.pack_setpoint(0, value, 0, None, 250),
        lambda value: wire.pack_setpoint(0, 0, value, None, 250),
    ):
        with pytest.raises(ValueError):
            pack(bad)


@pytest.mark.parametrize(
    "fields",
    [(181, 0, 0, None, 250), (0, 91, 0, None, 250), (0, 0, 0, 900, 250), (0, 0, 0, None, 251)],
)
def test_a_setpoint_out_of_range_is_never_packed(fields):
    with pytest.raises(ValueError):
        wire.pack_setpoint(*fields)


@pytest.mark.parametrize("delay_ms", [9, 1001, -1])
def test_a_panic_delay_out_of_range_is_never_packed(delay_ms):
    with pytest.raises(ValueError):
        wire.pack_panic(True, delay_ms)
