"""`up-ground send`: real programs, a real proxy, a small aircraft."""

import json
import re
import socket

import pytest

from tests.ground.aircraft import Aircraft, Ground, frame, ground, until
from tests.proxy.program import Client


def test_an_ack_is_shown_with_its_time(proxy, tmp_path):
    with Aircraft(proxy.airborne_port) as aircraft:
        status, said, stderr = ground(
            tmp_path, proxy.ground_port, "send", "up.flight_mode.set", "mode=FBW"
        )
    assert (status, stderr) == (0, "")
    assert re.fullmatch(r"ack after \d+ ms\n", said)
    (message,) = aircraft.received
    assert message["name"] == "up.flight_mode.set"
    assert message["data"] == {"mode": "FBW"}
    assert message["id"]
    assert 4711 < message["beacon"] <= aircraft.beacon


def test_a_nack_is_shown_with_its_reason_and_cannot_paint_the_terminal(proxy, tmp_path):
    def refuse(message):
        data = {"id": message["id"], "code": "refused", "reason": "throttle \x1b[31mis not low\x07"}
        return [("up.nack", data)]

    with Aircraft(proxy.airborne_port, {"up.arm": refuse}):
        status, said, stderr = ground(tmp_path, proxy.ground_port, "send", "up.arm")
    assert (status, said) == (1, "")
    assert stderr == "up-ground: refused: throttle \\x1b[31mis not low\\x07 (refused)\n"


def test_no_answer_says_that_nothing_is_known(proxy, tmp_path):
    with Aircraft(proxy.airborne_port, {"up.disarm": lambda message: []}) as aircraft:
        status, said, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert (status, said) == (3, "")
    assert "no answer within 3 s" in stderr
    assert len(aircraft.received) == 1


def test_the_answer_of_somebody_else_is_not_ours(proxy, tmp_path):
    def other(message):
        return [("up.ack", {"id": "somebody"}), ("up.nack", {"id": "else", "code": "refused"})]

    with Aircraft(proxy.airborne_port, {"up.disarm": other}):
        status, said, _ = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert (status, said) == (3, "")


def gains(p):
    axis = {"p": p, "i": 0, "d": 0.25}
    return {name: {"ailerons": axis, "elevator": axis} for name in ("ratePIDs", "stabPIDs")}


@pytest.mark.parametrize("is_acked_first", [True, False])
def test_what_was_asked_for_is_printed_with_the_ack(proxy, tmp_path, is_acked_first):
    def answer(message):
        both = [("up.ack", {"id": message["id"]}), ("arduino.pids.values", gains(1.5))]
        return both if is_acked_first else both[::-1]

    with Aircraft(proxy.airborne_port, {"arduino.pids.tunings": answer}):
        status, said, _ = ground(
            tmp_path, proxy.ground_port, "send", "arduino.pids.tunings", "request=true"
        )
    assert status == 0
    line = next(each for each in said.splitlines() if each.startswith("arduino.pids.values "))
    assert json.loads(line.split(" ", 1)[1]) == gains(1.5)
    assert "ack after" in said


def test_a_profile_that_was_asked_for_is_printed(proxy, tmp_path):
    def answer(message):
        profile = {"mix": "V-tail", "rudder": {"trim_us": -20}}
        return [("up.ack", {"id": message["id"]}), ("arduino.profile.values", profile)]

    with Aircraft(proxy.airborne_port, {"arduino.profile.request": answer}):
        status, said, _ = ground(tmp_path, proxy.ground_port, "send", "arduino.profile.request")
    assert status == 0
    assert 'arduino.profile.values {"mix": "V-tail", "rudder": {"trim_us": -20}}' in said


def test_a_set_of_gains_waits_for_no_values(proxy, tmp_path):
    with Aircraft(proxy.airborne_port) as aircraft:
        words = ["send", "arduino.pids.tunings", "pids=" + json.dumps(gains(2))]
        status, said, _ = ground(tmp_path, proxy.ground_port, *words)
    assert (status, said.count("\n")) == (0, 1)
    assert len(aircraft.received) == 1


def test_gains_can_be_typed_one_by_one(proxy, tmp_path):
    words = [
        f"pids.{loop}.{axis}.{gain}={value}"
        for loop in ("ratePIDs", "stabPIDs")
        for axis in ("ailerons", "elevator")
        for gain, value in (("p", 2), ("i", 0), ("d", 0.25))
    ]
    with Aircraft(proxy.airborne_port) as aircraft:
        status, _, _ = ground(tmp_path, proxy.ground_port, "send", "arduino.pids.tunings", *words)
    assert status == 0
    assert aircraft.received[0]["data"] == {"pids": gains(2)}


def test_mistakes_send_nothing(proxy, tmp_path):
    with Aircraft(proxy.airborne_port) as aircraft:
        for words, sentence in (
            (["up.flight_mode.set", "mode=ACRO"], "mode must be one of"),
            (["up.flight_mode.set", "FBW"], "is no field"),
            (["up.flightmode.set"], "did you mean up.flight_mode.set"),
            (["up.telemetry.frequency", "frequency=1e999"], "data.frequency is inf"),
        ):
            status, said, stderr = ground(tmp_path, proxy.ground_port, "send", *words)
            assert (status, said) == (2, ""), stderr
            assert sentence in stderr
    assert aircraft.received == []


def test_an_unknown_name_is_sent_when_forced(proxy, tmp_path):
    def unknown(message):
        data = {"id": message["id"], "code": "unknown", "reason": "no such Command"}
        return [("up.nack", data)]

    with Aircraft(proxy.airborne_port, {"my.new.thing": unknown}) as aircraft:
        status, _, stderr = ground(
            tmp_path, proxy.ground_port, "send", "--force", "my.new.thing", "a.b=1"
        )
    assert status == 1
    assert stderr == "up-ground: refused: no such Command (unknown)\n"
    assert aircraft.received[0]["data"] == {"a": {"b": 1}}


def test_an_absent_aircraft_is_named(proxy, tmp_path):
    status, _, stderr = ground(
        tmp_path, proxy.ground_port, "--aircraft", "glider", "send", "up.disarm"
    )
    assert status == 3
    assert stderr == "up-ground: the aircraft glider is not connected to the proxy\n"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["up.arm", "android.speak"])
def test_nothing_is_sent_without_a_beacon(proxy, tmp_path, name):
    """It waits for a frame of the slowest telemetry, and then gives up."""
    data = ["text=hello"] if name == "android.speak" else []
    with Aircraft(proxy.airborne_port) as aircraft:
        aircraft.is_quiet = True
        status, _, _ = ground(tmp_path, proxy.ground_port, "send", name, *data)
    assert status == 3
    assert aircraft.received == []


def test_a_closed_port_is_one_sentence(tmp_path):
    status, said, stderr = ground(tmp_path, 1, "send", "up.disarm")
    assert (status, said) == (3, "")
    assert stderr == "up-ground: cannot reach 127.0.0.1:1: connection refused\n"


def test_who_commands_is_named_when_the_seat_is_taken(proxy, tmp_path):
    hello = "UP1 aircraft=default seat=command\n"
    with Aircraft(proxy.airborne_port) as aircraft, Client(proxy.ground_port, hello) as other:
        other.expect("seat=command")
        status, _, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert status == 1
    assert "ground 1 commands this aircraft" in stderr
    assert aircraft.received == []


def test_a_seat_that_is_kept_for_somebody_is_waited_for(proxy, tmp_path):
    with Aircraft(proxy.airborne_port) as aircraft:
        with Client(proxy.ground_port, "UP1 aircraft=default seat=command\n") as other:
            other.expect("seat=command")
        status, said, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert status == 0, stderr
    assert "ack after" in said
    assert len(aircraft.received) == 1


def test_the_next_send_takes_the_seat_back_with_its_token(proxy, tmp_path):
    with Aircraft(proxy.airborne_port):
        assert ground(tmp_path, proxy.ground_port, "send", "up.disarm")[0] == 0
        (token,) = (tmp_path / "state" / "up-ground").glob("*.token")
        kept = token.read_text()
        assert ground(tmp_path, proxy.ground_port, "send", "up.disarm")[0] == 0
        assert token.read_text() == kept


def test_two_programs_of_one_user_do_not_take_the_seat_from_each_other(proxy, tmp_path):
    with (
        Aircraft(proxy.airborne_port),
        Ground(tmp_path, proxy.ground_port, "watch", "--seat", "command") as watching,
    ):
        watching.expect("seat command")
        status, _, stderr = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
        assert status == 1
        assert "ground 1 commands this aircraft" in stderr
        lines = watching.said.count("\n")
        until(lambda: watching.said.count("\n") > lines + 1, "more lines")
        assert "link down" not in watching.said
        assert "seat listen" not in watching.said


def test_a_thesis_proxy_is_spoken_to_without_a_hello(proxy, tmp_path):
    with Aircraft(proxy.airborne_port, hello=b"") as aircraft:
        status, said, stderr = ground(tmp_path, proxy.ground_port, "--direct", "send", "up.disarm")
    assert status == 0, stderr
    assert "ack after" in said
    assert aircraft.received[0]["name"] == "up.disarm"


def test_garbage_from_the_aircraft_does_not_keep_the_answer_away(proxy, tmp_path):
    def garbage(message):
        aircraft.send(b'{"name": "up.telemetry.update", "data": {"altitude": NaN}}\n')
        aircraft.send(b"\xff\xfe not json\n" + b"x" * 20000 + b"\n[1, 2]\n")
        return [("up.ack", {"id": message["id"]})]

    with Aircraft(proxy.airborne_port, {"up.disarm": garbage}, frame()) as aircraft:
        status, said, _ = ground(tmp_path, proxy.ground_port, "send", "up.disarm")
    assert status == 0
    assert "ack after" in said


def test_who_answers_no_hello_is_told_apart_from_a_proxy(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        with Ground(tmp_path, port, "send", "up.disarm") as sending:
            peer, _ = server.accept()
            with peer:
                peer.sendall(b'{"name": "up.telemetry.update", "data": {}}\n')
                assert sending.wait() == 3
    assert "does not answer a hello" in sending.stderr
    assert "--direct" in sending.stderr


def test_a_refusal_of_the_proxy_is_shown(tmp_path):
    with (
        socket.create_server(("127.0.0.1", 0)) as server,
        Ground(tmp_path, server.getsockname()[1], "send", "up.disarm") as sending,
    ):
        peer, _ = server.accept()
        with peer:
            peer.sendall(b'UP1 error code=full reason="as many grounds as it may"\n')
            assert sending.wait() == 1
    assert sending.stderr == "up-ground: the proxy refuses: as many grounds as it may (full)\n"


def test_only_the_name_is_required(tmp_path):
    status, said, stderr = ground(tmp_path, 1, "send")
    assert (status, said) == (2, "")
    assert stderr.endswith("the following arguments are required: NAME\n")
