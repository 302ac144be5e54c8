"""The list of flight modes: its bytes, and a ground station that reads it and selects each."""

from collections import Counter

import pytest
from pymavlink.dialects.v20 import development

from tests.mavlink.rig import MAVRig, m
from up.telemetry_frame import Frame
from up_mavlink import modes
from up_mavlink.codec import Codec
from up_mavlink.modes import ModeList, current_mode, mode_of, numbers_of
from up_mavlink.personas import BY_NAME

ARDUPILOT, PX4 = BY_NAME["ardupilot"], BY_NAME["px4"]
ACCEPTED, UNSUPPORTED = 0, 3
AVAILABLE, NOT_SELECTABLE = 435, 2


def frame_of(*names, mode="LOITER", selected="LOITER"):
    control = {"modes": dict.fromkeys(names), "board_modes": ["FBW"], "mode": mode,
               "selected": selected}  # fmt: skip
    return Frame({"flight_mode": "SETPOINT", "flight_control": control})


def test_the_bytes_are_those_of_the_dialect_that_has_the_messages():
    frame = frame_of("EIGHT", "LOITER", mode="CIRCLE")
    listed = ModeList(ARDUPILOT)
    listed.update(frame)
    ours = [*listed.messages(m, 0), current_mode(m, frame, ARDUPILOT), listed.monitor(m)]
    codec, peer = Codec(m, 1, Counter()), development.MAVLink(None, srcSystem=1, srcComponent=1)
    eight = numbers_of(ARDUPILOT, frame)["EIGHT"]
    modes_ = [("EIGHT", eight, 0), ("LOITER", 12, 0), ("FBW", 5, 0), ("RATE", 4, 2),
              ("ACRO", 0, 2), ("CIRCLE", 1, 2)]  # fmt: skip
    theirs = [
        development.MAVLink_available_modes_message(6, place, 0, number, bits, name.encode())
        for place, (name, number, bits) in enumerate(modes_, 1)
    ]
    theirs.append(development.MAVLink_current_mode_message(0, 1, 12))
    theirs.append(development.MAVLink_available_modes_monitor_message(listed._sequence))
    for our, their in zip(ours, theirs, strict=True):
        assert codec.pack(our) == their.pack(peer)
        peer.seq += 1


def test_a_mode_of_another_author_keeps_its_number_and_shares_it_with_none(monkeypatch):
    alone = numbers_of(PX4, frame_of("EIGHT"))["EIGHT"]
    assert numbers_of(PX4, frame_of("EIGHT", "LOITER", "THERMAL"))["EIGHT"] == alone
    # A main mode and a sub mode, as MAVSDK sends them.
    assert alone & 0xFFFF == 0
    monkeypatch.setattr(modes, "_SLOTS", 4)
    frame = frame_of("A1", "B2", "C3", "D4")
    for persona in (ARDUPILOT, PX4):
        numbers = numbers_of(persona, frame)
        assert len(set(numbers.values())) == len(numbers) == 8
        assert {mode_of(persona, frame, each) for each in numbers.values()} == set(numbers)


def ground(rig):
    client = rig.client()
    client.reader = development.MAVLink(None)
    client.reader.robust_parsing = True
    return client


def listed(client):
    """Request the modes one by one until the last, as QGroundControl does."""
    client.got.clear()
    while True:
        assert client.command(512, AVAILABLE, len(client.of("AVAILABLE_MODES")) + 1) == ACCEPTED
        found = client.of("AVAILABLE_MODES")
        if found[-1].mode_index >= found[-1].number_modes:
            return {each.mode_name: each for each in found}


@pytest.mark.parametrize("persona", ["ardupilot", "px4"])
def test_each_listed_mode_is_selected_by_its_number(tmp_path, persona):
    rig = MAVRig(tmp_path, persona=persona)
    rig.fly()
    client = ground(rig)
    found = listed(client)
    assert [each.mode_index for each in found.values()] == list(range(1, len(found) + 1))
    assert {"BANK", "LEVEL", "LOITER", "FBW"} <= set(found) and "AUTO" not in found
    for name in ("BANK", "LOITER", "LEVEL"):
        assert found[name].properties == 0
        number = found[name].custom_mode
        if persona == "px4":
            client.send("set_mode", 1, 1, number)
        else:
            assert client.command(176, 1, number) == ACCEPTED
        rig.telemetry(flight_mode="SETPOINT")
        assert rig.shown()["selected"] == name
        rig.clock.advance(1.0)
        rig.endpoint._on_moment()
        assert client.of("HEARTBEAT")[-1].custom_mode == number
    client.got.clear()
    assert client.command(512, AVAILABLE, 0) == ACCEPTED
    assert len(client.of("AVAILABLE_MODES")) == len(found)
    assert client.command(512, AVAILABLE, len(found) + 1) == UNSUPPORTED


def test_a_mode_that_is_no_longer_offered_changes_the_list(tmp_path):
    rig = MAVRig(tmp_path)
    client = ground(rig)
    before = listed(client)["LOITER"]
    rig.clock.advance(4.0)
    rig.frame()
    content = rig.up.telemetry_controller.collect()
    for _ in range(2):
        client.got.clear()
        rig.endpoint.on_frame(content, 1)
        client.command(512, 437)
        sequence = client.of("AVAILABLE_MODES_MONITOR")[-1].seq
    after = listed(client)["LOITER"]
    assert (before.properties, after.properties) == (0, NOT_SELECTABLE)
    assert before.custom_mode == after.custom_mode == 12
    rig.telemetry()
    client.command(512, 437)
    assert client.of("AVAILABLE_MODES_MONITOR")[-1].seq == (sequence + 1) % 256


def test_the_persona_generic_has_no_list(tmp_path):
    rig = MAVRig(tmp_path, persona="generic")
    client = ground(rig)
    rig.telemetry()
    assert client.command(512, AVAILABLE, 0) == UNSUPPORTED
    assert client.of("HEARTBEAT")[-1].custom_mode == 0
    assert not client.of("AVAILABLE_MODES_MONITOR")
