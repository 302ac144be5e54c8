"""Packets: golden bytes, and noise."""

import struct
from collections import Counter

from hypothesis import given, settings
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as m

from up.telemetry_frame import Frame
from up_mavlink.codec import Codec
from up_mavlink.command_table import of_long
from up_mavlink.modes import number_of
from up_mavlink.personas import BY_NAME, PERSONAS
from up_mavlink.signing import Signing
from up_mavlink.streams import DEFAULTS_S
from up_mavlink.telemetry_messages import BUILDERS, heartbeat

FRAME = {
    "armed": True, "in_flight": True, "flight_mode": "SETPOINT",
    "flight_control": {"mode": "LOITER"}, "vetoes": [],
    "orientation": {"roll": 90.0, "pitch": -45.0, "yaw": 350.0},
    "rates": {"roll": 0.0, "pitch": 0.0, "yaw": 180.0},
    "navigation": {"latitude": 48.0, "longitude": -17.5, "altitude": 250.5, "height": 50.25,
                   "speed": 10.0, "course": 90.0, "climb": 1.5, "heading": 95.0,
                   "airspeed": 12.0},
    "home": {"latitude": 47.0, "longitude": 17.0, "altitude": 200.0},
    "system": {"clock_ms": 1000}, "age_ms": {"location": 10, "navigation": 10, "orientation": 5},
    "location": {"latitude": 48.0, "longitude": -17.5, "altitude": 251.0},
    "arduino": {"flight_battery_v": 11.1, "imu_valid": True, "receiver_valid": True},
}  # fmt: skip


def codec(**more):
    return Codec(m, 1, Counter(), **more)


def test_golden_heartbeat():
    packet = codec().pack(heartbeat(m, Frame(FRAME), BY_NAME["ardupilot"]))
    # By the document of the protocol: FD, 9 bytes, flags, sequence, 1/1, id 0, fields, CRC.
    assert packet[:10].hex() == "fd09000000" + "0101000000"
    assert packet[10:19] == struct.pack("<IBBBBB", 12, 1, 3, 129, 4, 3)
    assert packet[19:].hex() == "5733"


def test_golden_position():
    message = BUILDERS["GLOBAL_POSITION_INT"][0](m, Frame(FRAME))
    fields = struct.unpack("<IiiiihhhH", codec().pack(message)[10:-2])
    assert fields == (1000, 480000000, -175000000, 250500, 50250, 0, 1000, -150, 9500)


def test_attitude_is_in_radians():
    attitude = BUILDERS["ATTITUDE"][0](m, Frame(FRAME))
    got = [round(each, 4) for each in (attitude.roll, attitude.pitch, attitude.yaw)]
    assert got == [1.5708, -0.7854, -0.1745]
    assert round(attitude.yawspeed, 4) == 3.1416


def test_the_mode_numbers_of_the_personas_are_unambiguous_where_they_select():
    numbers = {name: number_of(BY_NAME[name], Frame(), "LOITER") for name in PERSONAS}
    assert numbers == {"ardupilot": 12, "px4": 4 << 16 | 3 << 24, "generic": 0}
    for name in ("ardupilot", "px4"):
        persona = BY_NAME[name]
        for mode in ("FBW", "CRUISE", "LOITER", "MISSION", "RETURN", "GUIDED", "LAND", "TAKEOFF"):
            assert persona.mode_of(number_of(persona, Frame(), mode)) == mode
    assert BY_NAME["ardupilot"].mode_of(16) is None


_VALUES = st.recursive(
    st.none() | st.booleans() | st.text(max_size=5) | st.lists(st.text(max_size=3), max_size=3)
    | st.floats(-1e30, 1e30),
    lambda inner: st.dictionaries(st.sampled_from([*list(FRAME), "roll", "latitude"]), inner),
    max_leaves=5,
)  # fmt: skip


@given(st.dictionaries(st.sampled_from(list(FRAME)), _VALUES), st.booleans())
def test_every_message_of_any_telemetry_can_be_packed(content, is_whole):
    frame, packs = Frame({**FRAME, **content} if is_whole else content), codec()
    for persona in PERSONAS:
        packs.pack(heartbeat(m, frame, BY_NAME[persona]))
    for name in BUILDERS:
        message = BUILDERS[name][0](m, frame)
        assert message is None or packs.pack(message)
    assert set(BUILDERS) <= set(DEFAULTS_S)


@given(st.lists(st.binary(max_size=300) | st.just(b"\xfd\x09\x00\x00"), max_size=8))
def test_noise_is_dropped_and_what_is_kept_is_bounded(chunks):
    parser = codec()
    for chunk in chunks:
        parser.parse(chunk)
        assert len(parser._mav.buf) <= 280 + 13
    # Bytes of the next packets may be taken for the rest of a broken one.
    packet = codec().pack(m.MAVLink_ping_message(1, 2, 3, 4))
    assert any(parser.parse(packet) for _ in range(20))


def test_a_stream_that_never_pauses_needs_no_more_memory():
    parser, packet = codec(), codec().pack(m.MAVLink_ping_message(1, 2, 3, 4))
    parser.parse(packet[:5])
    for _ in range(100):
        assert len(parser.parse(packet[5:] + packet[:5])) == 1
        assert len(parser._mav.buf) == 5


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 60), st.integers(1, 255))
def test_a_changed_byte_of_a_signed_packet_is_refused(place, change):
    sender, receiver = codec(signing=Signing(bytes(32))), codec(signing=Signing(bytes(32)))
    message = m.MAVLink_command_long_message(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 9.0)
    packet = bytearray(sender.pack(message))
    packet[place % len(packet)] ^= change
    assert not receiver.parse(bytes(packet))


@given(st.lists(st.floats(width=32), min_size=7, max_size=7))
def test_a_parameter_that_is_not_finite_is_unused(params):
    request = of_long(m.MAVLink_command_long_message(1, 1, 192, 0, *params))
    assert all(each is None or abs(each) < float("inf") for each in request.params)
