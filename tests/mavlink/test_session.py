"""One client: commands, parameters, plans, streams, texts, time."""

import math
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raspilot.modules.failsafes import Failsafes
from raspilot.modules.parameters import Parameters
from tests.mavlink.rig import MAVRig, m
from tests.raspilot.mission.plans_rig import placed
from up.commands.roles import Role
from up_mavlink.modes import numbers_of
from up_mavlink.personas import BY_NAME

ACCEPTED, REJECTED, DENIED, UNSUPPORTED, FAILED, IN_PROGRESS = range(6)
NAN = math.nan


_NUMBERS = {"float": st.floats(width=32), "double": st.floats()}


def _field(kind, length):
    if kind == "char":
        return st.binary(min_size=length, max_size=length)
    bits, is_signed = int("".join(filter(str.isdigit, kind)) or 0), not kind.startswith("u")
    some = st.integers(0, 2 ** (bits - is_signed) - 1) | st.integers(0, 5) if bits else None
    some = some if bits else _NUMBERS[kind]
    return st.lists(some, min_size=length, max_size=length) if length else some


def _messages(name):
    cls = getattr(m, f"MAVLink_{name}_message")
    fields = zip(cls.fieldnames, cls.fieldtypes, strict=True)
    lengths = dict(zip(cls.ordered_fieldnames, cls.array_lengths, strict=True))
    fixed = {"target_system": st.just(1), "target_component": st.just(1)}
    kinds = [fixed[name] if name in fixed else _field(kind, lengths[name]) for name, kind in fields]
    return st.tuples(st.just(name), *kinds)


KINDS = (
    "heartbeat", "command_long", "command_int", "set_mode", "mission_count", "mission_item",
    "mission_item_int", "mission_request_list", "mission_request_int", "mission_request",
    "mission_clear_all", "mission_ack", "mission_set_current", "param_request_list",
    "param_request_read", "param_set", "request_data_stream", "timesync", "ping",
    "file_transfer_protocol",
)  # fmt: skip


@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(st.one_of(*map(_messages, KINDS)), min_size=1, max_size=12))
def test_no_message_breaks_the_session(tmp_path_factory, messages):
    rig = MAVRig(tmp_path_factory.mktemp("rig"))
    client = rig.client()
    for name, *fields in messages:
        client.send(name, *fields)
    rig.clock.pump([0.25] * 8)
    rig.telemetry()
    assert client.of("HEARTBEAT")


@pytest.fixture
def rig(tmp_path):
    return MAVRig(tmp_path)


def board_accepts(rig):
    rig.board.answer.callback(None)
    rig.settle()


def heartbeat(client, kind=6):
    client.send("heartbeat", kind, 8, 0, 0, 4, 3)


def upload(client, rows, type_=0, ticks=200):
    """Answer requests for rows; return the result of the last MISSION_ACK."""
    client.got.clear()
    client.send("mission_count", 1, 1, len(rows), type_)
    for _ in range(ticks):
        requests = [each for each in client.of("MISSION_REQUEST_INT")]
        client.got = [each for each in client.got if each not in requests]
        for request in requests:
            number = request.seq
            frame, command, params, x, y, z = rows[number]
            client.send("mission_item_int", 1, 1, number, frame, command, 0, 1, *params,
                        round(x * 1e7), round(y * 1e7), z, type_)  # fmt: skip
        acks = client.of("MISSION_ACK")
        if acks:
            return acks[-1].type
        client.rig.clock.advance(0.1)
        client.rig.settle()
    return None


def download(client, type_=0):
    client.got.clear()
    client.send("mission_request_list", 1, 1, type_)
    count = client.of("MISSION_COUNT")[-1].count
    for number in range(count):
        client.send("mission_request_int", 1, 1, number, type_)
    return client.of("MISSION_ITEM_INT")


def waypoint(north, east, altitude=60.0, frame=6):
    where = placed(north, east)
    return (frame, 16, (0.0, 0.0, 0.0, NAN), where["latitude"], where["longitude"], altitude)


HOME_ROW = (0, 16, (0.0, 0.0, 0.0, 0.0), 48.0, 17.0, 200.0)
SPEED_ROW = (2, 178, (1.0, 12.0, -1.0, 0.0), 0.0, 0.0, 0.0)
ROUTE = [waypoint(400, 0), SPEED_ROW, waypoint(400, 400), waypoint(0, 400)]


@pytest.mark.parametrize(
    ("number", "params", "selected"),
    [
        (176, (1, 12), "LOITER"),
        (176, (1, 11), "RETURN"),
        (17, (), "LOITER"),
        (20, (), "RETURN"),
        (193, (0,), "LOITER"),
    ],
)
def test_a_command_selects_a_mode(rig, number, params, selected):
    rig.state("FBW")
    rig.setpoint()
    client = rig.client()
    assert client.command(number, *params) is None
    board_accepts(rig)
    assert (client.result(number), rig.shown()["selected"]) == (ACCEPTED, selected)


def test_a_command_that_is_repeated_while_it_is_carried_out_is_carried_out_once(rig):
    rig.state("FBW")
    rig.setpoint()
    client = rig.client()
    client.command(20)
    client.command(20, confirmation=1)
    assert client.result(20) == IN_PROGRESS
    assert rig.board.asked == ["AUTO"]
    board_accepts(rig)
    assert client.result(20) == ACCEPTED


@pytest.mark.parametrize(
    ("number", "params", "result"),
    [
        (176, (1, 2), DENIED),
        (300, (), DENIED),
        (400, (0.5,), DENIED),
        (400, (NAN,), DENIED),
        (246, (1,), UNSUPPORTED),
        (511, (9999, 1e5), UNSUPPORTED),
        (519, (1,), UNSUPPORTED),
        (192, (0, 0, 0, 0, NAN, NAN, NAN), DENIED),
    ],
)
def test_a_refused_command_has_a_result_and_a_reason(rig, number, params, result):
    rig.fly()
    client = rig.client()
    assert client.command(number, *params) == result
    assert bool(client.texts) is (result == DENIED)


@pytest.mark.parametrize(
    ("frame", "altitude", "expected"), [(0, 260.0, 260.0), (3, 80.0, 280.0), (6, NAN, 250.0)]
)
def test_reposition_flies_there(rig, frame, altitude, expected):
    rig.fly()
    client, where = rig.client(), placed(200, 100)
    place = (round(where["latitude"] * 1e7), round(where["longitude"] * 1e7), altitude)
    client.send("command_int", 1, 1, frame, 192, 0, 0, -1, 1, 0, NAN, *place)
    assert client.result(192) == ACCEPTED
    rig.setpoint()
    assert rig.shown()["selected"] == "GUIDED"
    target = rig.manager.situation.target
    assert abs(target.altitude_m - expected) < 1
    assert abs(target.point.north_m - 200) < 1


def selected(rig, client, number):
    """Select a mode; the next frame of telemetry has it."""
    assert client.command(176, 1, number) == ACCEPTED
    rig.telemetry(flight_mode="SETPOINT")


def test_altitude_and_course_change_in_the_mode_that_follows_them(rig):
    rig.fly()
    client, where = rig.client(), placed(200, 100)
    assert client.command(186, 300, 0) == DENIED
    selected(rig, client, 12)
    for number, params, expected in ((186, (300, 0), 300.0), (186, (90, 3), 290.0)):
        assert client.command(number, *params) == ACCEPTED
        assert rig.manager.required("altitude") == expected
    place = (round(where["latitude"] * 1e7), round(where["longitude"] * 1e7), 260.0)
    client.send("command_int", 1, 1, 0, 192, 0, 0, -1, 1, 70, NAN, *place)
    rig.telemetry()
    rig.telemetry(flight_mode="SETPOINT")
    client.send("command_int", 1, 1, 3, 43001, 0, 0, 0, 0, 0, 0, 0, 0, 80.0)
    assert client.result(43001) == ACCEPTED
    rig.setpoint()
    target = rig.manager.situation.target
    assert (round(target.altitude_m), round(target.radius_m)) == (280, 70)
    assert abs(target.point.north_m - 200) < 1
    selected(rig, client, numbers_of(BY_NAME["ardupilot"], rig.endpoint.aircraft.frame)["BANK"])
    assert client.command(43002, 0, 90) == ACCEPTED
    assert rig.manager.required("course") == 90.0
    assert client.command(43002, 1, 120) == client.command(43002, 0, NAN) == DENIED
    client.send("command_int", 1, 1, 8, 43001, 0, 0, 0, 0, 0, 0, 0, 0, 80.0)
    assert client.result(43001) == DENIED
    assert rig.manager.required("course") == 90.0


@pytest.mark.parametrize(
    ("height", "result", "mode"), [(0.0, ACCEPTED, "LAND"), (NAN, ACCEPTED, "LAND"),
                                   (60.0, DENIED, "LOITER")],
)  # fmt: skip
def test_land_at_a_place_lands_there_or_leaves_no_target_near_the_ground(rig, height, result, mode):
    rig.fly()
    client, where = rig.client(), placed(200, 100)
    place = (round(where["latitude"] * 1e7), round(where["longitude"] * 1e7))
    client.send("command_int", 1, 1, 3, 192, 0, 0, -1, 1, 0, NAN, *place, 80.0)
    rig.telemetry(flight_mode="SETPOINT")
    client.send("command_int", 1, 1, 3, 21, 0, 0, 0, 0, 0, NAN, *place, height)
    assert client.result(21) == result
    rig.setpoint()
    assert rig.shown()["selected"] == mode
    if result == ACCEPTED:
        assert abs(rig.manager.situation.target.point.north_m - 200) < 1
        assert round(rig.manager.situation.target.altitude_m) == 200


def test_guided_without_a_target_circles_here(rig):
    rig.fly()
    client, frame = rig.client(), rig.endpoint.aircraft.frame
    here = placed(100, 50)
    frame.content["location"] = {name: here[name] for name in ("latitude", "longitude")}
    assert client.command(176, 1, 15) == ACCEPTED
    rig.setpoint()
    assert rig.shown()["selected"] == "GUIDED"


def test_a_mission_with_home_speed_and_loss_arrives_and_comes_back_as_it_was_sent(rig):
    client, random = rig.client(), Random(3)
    take, on_bytes = client._take, client.session.on_bytes

    def lossy(call):
        return lambda data: None if random.random() < 0.03 else call(data)

    client._take = lossy(take)
    client.session._send_packet = lambda packet: client._take(packet)
    client.session.on_bytes = lossy(on_bytes)
    rows = [HOME_ROW, *ROUTE, *(waypoint(400 + 100 * (n % 2), 60.0 * n) for n in range(12))]
    assert upload(client, rows) == 0
    assert len(rig.plans.missions.items) == 16
    client._take, client.session.on_bytes = take, on_bytes
    rig.telemetry()
    back = download(client)
    assert [(each.frame, each.command) for each in back] == [row[:2] for row in rows]
    assert [round(each.x / 1e7, 7) for each in back] == [round(row[3], 7) for row in rows]
    assert client.of("MISSION_COUNT")[-1].mission_type == 0


def test_the_rows_of_a_mission_of_another_ground_have_home_for_ardupilot_only(tmp_path):
    for persona, commands in (("ardupilot", [16, 16, 178, 16, 16]), ("px4", [16, 178, 16, 16])):
        rig = MAVRig(tmp_path / persona, persona=persona)
        assert upload(rig.client(), ROUTE) == 0
        rig.telemetry()
        rig.endpoint.aircraft._rows.clear()
        assert [each.command for each in download(rig.client())] == commands


@pytest.mark.parametrize(
    ("rows", "result"),
    [
        ([(6, 3000, (1.0, 0, 0, 0), 0.0, 0.0, 0.0)], 3),
        ([(10, 16, (0, 0, 0, 0), 48.0, 17.0, 60.0)], 2),
        ([(6, 16, (0, 0, 0, 0), 0.0, 0.0, 60.0)], 5),
        ([waypoint(400, 0), waypoint(400, 0, 90000.0)], 5),
        ([waypoint(400, 0), waypoint(90_000, 0)], 5),
    ],
)
def test_a_mission_with_a_problem_is_refused_as_a_whole(rig, rows, result):
    client = rig.client()
    assert upload(client, rows) == result
    assert client.texts
    assert rig.plans.missions.items == ()


def test_an_upload_without_rows_ends(rig):
    client = rig.client()
    client.is_deaf = True
    client.send("mission_count", 1, 1, 3, 0)
    client.is_deaf = False
    rig.clock.pump([0.25] * 45)
    assert client.of("MISSION_ACK")[-1].type == 15


def test_a_fence_comes_back_and_is_cleared(rig):
    corners = [placed(*each) for each in ((900, 900), (-900, 900), (-900, -900), (900, -900))]
    rows = [(0, 5001, (4.0, 0, 0, 0), each["latitude"], each["longitude"], 0.0) for each in corners]
    where = placed(700, 700)
    rows.append((0, 5004, (50.0, 0, 0, 0), where["latitude"], where["longitude"], 0.0))
    client = rig.client()
    assert upload(client, rows, 1) == 0
    polygon, circle = rig.plans.fences.items
    assert (len(polygon.corners), polygon.is_inside) == (4, True)
    assert (circle.radius_m, circle.is_inside) == (50.0, False)
    rig.endpoint.aircraft._rows.clear()
    rig.telemetry()
    back = download(client, 1)
    assert [(each.command, each.param1) for each in back] == [(5001, 4.0)] * 4 + [(5004, 50.0)]
    assert upload(client, rows[:2], 1) == 5
    client.send("mission_clear_all", 1, 1, 1)
    rig.settle()
    assert rig.plans.fences.items == ()


def test_parameters_are_set_one_by_one_and_a_refused_one_keeps_its_value(rig):
    rig.state("FBW", armed=False, auto=False, in_flight=False)
    client = rig.client()
    client.send("param_set", 1, 1, b"RATE_RLL_P", 2.5, 9)
    client.send("param_set", 1, 1, b"RATE_RLL_D", 0.1, 9)
    assert rig.tuner.gains["ratePIDs"]["ailerons"] == {"p": 2.5, "i": 0.0, "d": 0.1}
    values = [(each.param_id, round(each.param_value, 5)) for each in client.of("PARAM_VALUE")]
    assert values == [("RATE_RLL_P", 2.5), ("RATE_RLL_D", 0.1)]
    tries = [(b"RATE_RLL_P", 51.0, 9), (b"RATE_RLL_P", NAN, 9), (b"RATE_RLL_P", 3.0, 6),
             (b"SYSID_THISMAV", 2.0, 9), (b"NO_SUCH", 2.0, 9)]  # fmt: skip
    for each in tries:
        client.send("param_set", 1, 1, *each)
    assert [each.error for each in client.of("PARAM_ERROR")] == [2, 2, 2, 5, 1]
    assert [each.param_value for each in client.of("PARAM_VALUE")[2:]] == [2.5, 2.5, 2.5, 1.0]
    client.send("param_set", 1, 1, b"TELEM_PERIOD_MS", 200.0, 9)
    assert rig.up.telemetry_controller.wanted_period_ms == 200


def test_keys_of_configuration_files_are_parameters_that_act_at_the_next_start(tmp_path):
    rig = MAVRig(tmp_path, modules=(Parameters, Failsafes))
    rig.state("FBW", armed=False, auto=False, in_flight=False)
    client = rig.client()

    def listed():
        client.got.clear()
        client.send("param_request_list", 1, 1)
        rig.clock.pump([0.01] * 400)
        rig.telemetry()
        return {each.param_id: each.param_value for each in client.of("PARAM_VALUE")}

    before = listed()
    assert len(before) == client.of("PARAM_VALUE")[0].param_count
    assert (before["LOITER_RADIUS_M"], before["RETURN_LAND"]) == (50.0, 0.0)
    for name, value in ((b"LOITER_RADIUS_M", 75.3), (b"RETURN_LAND", 1.0)):
        client.send("param_set", 1, 1, name, value, 9)
    assert "LOITER_RADIUS_M (loiter.yml: radius_m)" in "".join(client.texts)
    assert not client.of("PARAM_ERROR")
    assert (tmp_path / "loiter.yml").read_text() == "radius_m: 75.3\n"
    assert (tmp_path / "return.yml").read_text() == "land: true\n"
    after = listed()
    changed = {name for name in before if after[name] != before[name]}
    assert changed == {"LOITER_RADIUS_M", "RETURN_LAND"}
    assert round(after["LOITER_RADIUS_M"], 4) == 75.3
    client.send("param_set", 1, 1, b"LOITER_RADIUS_M", 1.0, 9)
    rig.state("FBW")
    client.send("param_set", 1, 1, b"LOITER_RADIUS_M", 60.0, 9)
    assert [each.error for each in client.of("PARAM_ERROR")] == [2, 3]
    assert (tmp_path / "loiter.yml").read_text() == "radius_m: 75.3\n"


def test_a_list_of_parameters_waits_for_control(rig):
    client, port = rig.client(), rig.endpoint.aircraft._port
    port.problem = "control is not granted yet"
    client.send("param_request_list", 1, 1)
    rig.clock.pump([0.1] * 10)
    assert not client.of("PARAM_VALUE")
    del port.problem
    rig.clock.pump([0.1] * 25)
    assert len(client.of("PARAM_VALUE")) == client.of("PARAM_VALUE")[0].param_count == 20


def test_a_message_interval_holds_for_one_client(rig):
    one, other = rig.client(), rig.client()
    assert one.command(511, 30, 5e4) == ACCEPTED
    assert one.command(511, 74, -1) == ACCEPTED
    assert one.command(510, 30) == ACCEPTED
    assert one.of("MESSAGE_INTERVAL")[-1].interval_us == 50_000
    for _ in range(10):
        rig.clock.advance(0.05)
        rig.telemetry()
    assert len(one.of("ATTITUDE")) == 10
    assert len(other.of("ATTITUDE")) == len(other.of("VFR_HUD")) == 3
    assert len(one.of("VFR_HUD")) == 0


def test_a_client_that_floods_is_limited(rig):
    client = rig.client()
    packet = client.pack("command_long", 1, 1, 246, 0, 0, 0, 0, 0, 0, 0, 0)
    client.session.on_bytes(packet * 600)
    assert rig.endpoint.counters["too_many"] == 200


def test_files_are_refused_and_the_clocks_are_compared(rig):
    client = rig.client()
    client.send("file_transfer_protocol", 0, 1, 1, [7, 0, 3, 4, 0] + [0] * 246)
    payload = bytes(client.of("FILE_TRANSFER_PROTOCOL")[-1].payload)
    assert (payload[:2], payload[2:6], payload[12]) == (b"\x08\0", b"\x03\x81\x01\x04", 10)
    client.send("timesync", 0, 12345)
    assert client.of("TIMESYNC")[-1].ts1 == 12345
    assert client.of("TIMESYNC")[-1].tc1 > 0


def test_events_become_texts_once(rig):
    client = rig.client()
    rig.telemetry()
    client.got.clear()
    for name in ("a veto with a long name " * 4, "b"):
        rig.up.vetoes.set("test", name)
        rig.clock.advance(4.0)
        rig.telemetry()
        rig.telemetry()
    parts = client.of("STATUSTEXT")
    assert [each.chunk_seq for each in parts[:3]] == [0, 1, 2]
    whole = "".join(each.text for each in parts[:3])
    assert whole.startswith("vetoes against arming: test: a veto with a long name")
    assert [each.text for each in parts[3:]] == ["vetoes against arming: test: b"]


def test_without_telemetry_the_heartbeat_ends(rig):
    client = rig.client()
    for _ in range(8):
        rig.clock.advance(1.0)
        rig.endpoint._on_moment()
    assert len(client.of("HEARTBEAT")) == 3


@pytest.mark.parametrize(
    ("role", "kind", "counts"),
    [(Role.OPERATOR, 6, True), (Role.OBSERVER, 6, False), (Role.PILOT, 2, False)],
)
def test_a_ground_station_counts_while_its_heartbeats_arrive(tmp_path, role, kind, counts):
    rig = MAVRig(tmp_path, role=role)
    client = rig.client()
    heartbeat(client, kind)
    control = rig.module.mission_control
    assert control.has_ground is counts
    rig.clock.advance(5.1)
    assert control.has_ground is False


def test_a_row_is_reached_when_the_next_one_is_flown(rig):
    client = rig.client()
    rig.fly()
    content = dict(rig.endpoint.aircraft.frame.content)
    for mode, item, is_finished in (
        ("LOITER", 1, False), ("LOITER", 3, False), ("MISSION", 3, False), ("MISSION", 4, False),
        ("MISSION", 4, True),
    ):  # fmt: skip
        plan = {"id": "x", "count": 4, "item": item, "is_finished": is_finished}
        control = {"mode": mode, "selected": mode}
        more = {"mission": plan, "flight_control": control, "flight_mode": "SETPOINT"}
        rig.endpoint.on_frame({**content, **more}, 1)
    assert [each.seq for each in client.of("MISSION_ITEM_REACHED")] == [3, 4]


def test_too_many_clients_are_refused_and_counted(rig):
    found = [rig.client().session for _ in range(9)]
    assert found[-1] is None
    assert rig.module.telemetry_content["counters"]["mavlink"]["tcpin:127.0.0.1:0"] == {
        "clients": 8,
        "too_many_clients": 1,
    }
