import json
import socket

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.ground.aircraft import Aircraft, Ground, coded, codes, frame, ground, until
from tests.proxy.program import Program
from up.cli.cli_error import UsageError
from up_ground.send import parse_fields


def gains(p):
    axis = {"p": p, "i": 0, "d": 0.25}
    return {name: {"ailerons": axis, "elevator": axis} for name in ("ratePIDs", "stabPIDs")}


def ack(message):
    return ("up.ack", {"id": message["id"]})


def test_an_ack_is_shown_and_the_next_send_regains_control_with_its_token(proxy, tmp_path):
    command = ["send", "up.flight_mode.set", "mode=FBW"]
    with Aircraft(proxy.airborne_port) as aircraft:
        status, said, stderr = ground(tmp_path, proxy.ground_port, *command)
        assert (status, codes(said), stderr) == (0, ["ack"], "")
        (message,) = aircraft.received
        assert (message["name"], message["data"]) == ("up.flight_mode.set", {"mode": "FBW"})
        assert message["id"]
        assert 4711 < message["beacon"] <= aircraft.beacon
        (token,) = (tmp_path / "state" / "up-ground").glob("*.token")
        kept = token.read_text()
        assert ground(tmp_path, proxy.ground_port, *command)[0] == 0
        assert token.read_text() == kept


def test_a_nack_is_shown_with_its_reason_and_cannot_paint_the_terminal(proxy, tmp_path):
    def refuse(message):
        data = {"id": message["id"], "code": "refused", "reason": "throttle \x1b[31mlow\x07"}
        return [("up.nack", data)]

    with Aircraft(proxy.airborne_port, {"up.arm": refuse}):
        command = ["send", "up.arm"]
        status, said, stderr = ground(tmp_path, proxy.ground_port, *command, UP_LOG_FORMAT="")
    assert (status, said) == (1, "")
    assert stderr == "up-ground: refused: throttle \\x1b[31mlow\\x07 (refused)\n"


@pytest.mark.parametrize(
    "answers",
    [[], [("up.ack", {"id": "another"}), ("up.nack", {"id": "other", "code": "refused"})]],
    ids=["none", "of another ground"],
)
def test_without_our_answer_the_outcome_is_unknown(proxy, tmp_path, answers):
    with Aircraft(proxy.airborne_port, {"up.disarm": lambda message: answers}) as aircraft:
        status, said, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert (status, said, codes(stderr)) == (3, "", ["no_answer"])
    assert len(aircraft.received) == 1


@pytest.mark.parametrize("is_acked_first", [True, False])
def test_requested_content_is_printed_with_the_ack(proxy, tmp_path, is_acked_first):
    def answer(message):
        both = [ack(message), ("arduino.pids.values", gains(1.5))]
        return both if is_acked_first else both[::-1]

    with Aircraft(proxy.airborne_port, {"arduino.pids.tunings": answer}):
        command = ["send", "arduino.pids.tunings", "request=true"]
        status, said, _ = ground(tmp_path, proxy.ground_port, *command)
    assert (status, sorted(codes(said))) == (0, ["ack", "message"])
    (content,) = (each for each in coded(said) if each["code"] == "message")
    assert (content["name"], content["data"]) == ("arduino.pids.values", gains(1.5))


def test_a_set_of_gains_typed_one_by_one_waits_for_no_values(proxy, tmp_path):
    words = [
        f"pids.{loop}.{axis}.{gain}={value}"
        for loop in ("ratePIDs", "stabPIDs")
        for axis in ("ailerons", "elevator")
        for gain, value in (("p", 2), ("i", 0), ("d", 0.25))
    ]
    with Aircraft(proxy.airborne_port) as aircraft:
        command = ["send", "arduino.pids.tunings", *words]
        status, said, _ = ground(tmp_path, proxy.ground_port, *command)
    assert (status, codes(said)) == (0, ["ack"])
    assert [each["data"] for each in aircraft.received] == [{"pids": gains(2)}]


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["up.telemetry.frequency", "frequency=1"], "invalid_data"),
        (["up.flight_mode.set", "FBW"], "invalid_field"),
        (["up.flightmode.set"], "unknown_command"),
        (["up.telemetry.frequency", "frequency=1e999"], "not_encodable"),
    ],
)
def test_mistakes_are_found_before_a_connection(tmp_path, words, code):
    status, said, stderr = ground(tmp_path, 1, "send", *words)
    assert (status, said, codes(stderr)) == (2, "", [code])


def test_only_the_name_is_required(tmp_path):
    status, said, stderr = ground(tmp_path, 1, "send")
    assert (status, said) == (2, "")
    assert "NAME" in stderr
    assert "key=value" not in stderr


def test_an_unknown_name_is_sent_when_forced(proxy, tmp_path):
    def unknown(message):
        return [("up.nack", {"id": message["id"], "code": "unknown", "reason": "unknown"})]

    with Aircraft(proxy.airborne_port, {"my.new.thing": unknown}) as aircraft:
        command = ["send", "--force", "my.new.thing", "a.b=1"]
        status, _, stderr = ground(tmp_path, proxy.ground_port, *command)
    assert (status, codes(stderr)) == (1, ["unknown"])
    assert aircraft.received[0]["data"] == {"a": {"b": 1}}


def test_an_absent_aircraft_is_reported(proxy, tmp_path):
    status, _, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert (status, codes(stderr)) == (3, ["aircraft_offline"])


@pytest.mark.slow
def test_nothing_is_sent_without_a_beacon(proxy, tmp_path):
    """It waits for a frame of the slowest telemetry, and then gives up."""
    with Aircraft(proxy.airborne_port) as aircraft:
        aircraft.is_quiet = True
        status, _, stderr = ground(tmp_path, proxy.ground_port, "send", "up.arm")
    assert (status, codes(stderr)) == (3, ["no_telemetry"])
    assert aircraft.received == []


def test_a_closed_port_is_reported(tmp_path):
    status, said, stderr = ground(tmp_path, 1, "send", "up.disarm")
    assert (status, said, codes(stderr)) == (3, "", ["unreachable"])


def test_the_owner_of_control_is_named(proxy, owner, tmp_path):
    with Aircraft(proxy.airborne_port) as aircraft:
        status, _, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert (status, coded(stderr)) == (1, [{"code": "control_held", "owner": 1}])
    assert aircraft.received == []


def test_control_that_is_reserved_for_another_ground_is_waited_for(proxy, owner, tmp_path):
    with Aircraft(proxy.airborne_port) as aircraft:
        owner.close()
        status, said, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert (status, codes(said)) == (0, ["ack"]), stderr
    assert len(aircraft.received) == 1


def test_two_programs_of_one_user_do_not_take_control_from_each_other(proxy, tmp_path):
    with (
        Aircraft(proxy.airborne_port),
        Ground(tmp_path, proxy.ground_port, "watch", "--seat", "command") as watching,
    ):
        watching.expect("control ours")
        status, _, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
        assert (status, codes(stderr)) == (1, ["control_held"])
        lines = watching.said.count("\n")
        until(lambda: watching.said.count("\n") > lines + 1, "more lines")
        assert "link down" not in watching.said
        assert "not ours" not in watching.said


def test_a_legacy_proxy_gets_no_hello(tmp_path):
    with (
        Program(tmp_path / "proxy", "metrics: false\n") as proxy,
        Aircraft(proxy.airborne_port, hello=b"") as aircraft,
    ):
        command = ["--direct", "send", "up.disarm"]
        status, said, stderr = ground(tmp_path, proxy.ground_port, *command)
    assert (status, codes(said)) == (0, ["ack"]), stderr
    assert aircraft.received[0]["name"] == "up.disarm"


def test_garbage_from_the_aircraft_does_not_hide_the_answer(proxy, tmp_path):
    def garbage(message):
        aircraft.send(b'{"name": "up.telemetry.update", "data": {"altitude": NaN}}\n')
        aircraft.send(b"\xff\xfe not json\n" + b"x" * 20000 + b"\n[1, 2]\n")
        return [ack(message)]

    with Aircraft(proxy.airborne_port, {"up.disarm": garbage}, frame()) as aircraft:
        status, said, _ = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert (status, codes(said)) == (0, ["ack"])


@pytest.mark.parametrize(
    ("line", "status", "code"),
    [
        (b'{"name": "up.telemetry.update", "data": {}}\n', 3, "no_proxy"),
        (b'UP1 error code=full reason="as many grounds as it may"\n', 1, "full"),
    ],
)
def test_a_peer_that_rejects_or_does_not_answer_the_hello(tmp_path, line, status, code):
    with (
        socket.create_server(("127.0.0.1", 0)) as server,
        Ground(tmp_path, server.getsockname()[1], "send", "up.disarm") as sending,
    ):
        peer, _ = server.accept()
        with peer:
            peer.sendall(line)
            assert sending.wait() == status
    assert codes(sending.stderr) == [code]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2", 2), ("2.5", 2.5), ("true", True), ("null", None), ('"2"', "2"), ("FBW", "FBW"),
        ("", ""), ("x=y", "x=y"), ("[1, 2]", [1, 2]), ("NaN", "NaN"), ("-Infinity", "-Infinity"),
    ],
)  # fmt: skip
def test_values_are_json_where_they_are_json_and_text_otherwise(text, value):
    assert parse_fields([f"a={text}"]) == {"a": value}


def test_dots_open_objects():
    words = ["pids.ratePIDs.ailerons.p=2", "pids.ratePIDs.ailerons.i=0", "pids.x=1"]
    assert parse_fields(words) == {"pids": {"ratePIDs": {"ailerons": {"p": 2, "i": 0}}, "x": 1}}


def test_a_number_for_a_text_stays_as_typed():
    typed = parse_fields(["value=80", "key=1.50", "file=true", "other=80", 'more="2"'],
                         {"value", "key", "file", "more"})  # fmt: skip
    assert typed == {"value": "80", "key": "1.50", "file": "true", "other": 80, "more": "2"}


@pytest.mark.parametrize(
    "words", [["a"], ["=1"], ["a.=1"], [".a=1"], ["a..b=1"], ["a=1", "a=2"], ["a=1", "a.b=2"]]
)
def test_what_is_no_field_is_refused(words):
    with pytest.raises(UsageError):
        parse_fields(words)


@given(st.lists(st.text(max_size=30), max_size=5))
def test_no_words_break_it(words):
    try:
        data = parse_fields(words)
    except UsageError as error:
        assert str(error)
    else:
        json.dumps(data)
