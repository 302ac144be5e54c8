"""The virtual phone as a program: its options, its lines, its end."""

import json
import subprocess

import pytest

from tests.support.java import CONSOLE, java_program
from up_simulator.phone.java_process import JavaPhoneProcess
from up_simulator.phone.java_program import MAIN

LIMIT_S = 60.0
PLACE = ["--raspberry", "127.0.0.1:50001:50000"]
SENSORS = {"fix", "pressure", "rotation", "battery", "record"}


@pytest.fixture(scope="module")
def program():
    return java_program()


def run(program, *options, main=MAIN, text=""):
    return subprocess.run(
        program.command(*options, main=main),
        input=text,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )


@pytest.fixture
def phone(program):
    made = JavaPhoneProcess(program, *PLACE, "--record", "--stepped")
    yield made
    made.end()


@pytest.mark.parametrize("main", [MAIN, CONSOLE])
def test_help_teaches(program, main):
    done = run(program, "--help", main=main)
    assert done.returncode == 0 and done.stderr == ""
    assert done.stdout.startswith("usage: ") and "try: (" in done.stdout
    assert all(len(line) < 100 for line in done.stdout.splitlines())


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--fly"], "--fly: no such option, or its value is missing; --help tells them"),
        (["--fly", "high"], "--fly: no such option; --help tells them"),
        (["--raspberry", "pi"], "--raspberry 'pi' is not HOST:GENERAL:ORIENTATION"),
        (["--raspberry", "pi:0:1"], "--raspberry: a port is 1 to 65535, not '0'"),
        (["--runner", "x:y"], "--runner: a port is 1 to 65535, not 'y'"),
        (
            ["--runner", "x:1", "--discover", "y:2"],
            "--runner and --discover are two ways of finding the same: choose one",
        ),
        (["--orientation", "ip"], "--orientation 'ip' is not off, tcp or udp"),
        (["--seed", "-1"], "--seed is 0 to 2147483647, not '-1'"),
        (["--mounting", "1 2 3"], "--mounting: the mounting is four numbers, not '1 2 3'"),
    ],
)
def test_a_wrong_option_is_one_sentence(program, options, sentence):
    done = run(program, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"virtual phone: {sentence}\n"


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--proxy", "x"], "--proxy 'x' is not HOST:PORT"),
        (["--seat", "air"], "--seat 'air' is not command or listen"),
        (["--aircraft", "a b"], "the aircraft's name must be 1 to 32 letters"),
    ],
)
def test_a_wrong_option_of_the_console_is_one_sentence(program, options, sentence):
    done = run(program, *options, main=CONSOLE)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"ground console: {sentence}")
    assert done.stderr.count("\n") == 1


def test_it_ends_with_its_input_and_says_what_it_counted(program):
    done = run(program, *PLACE)
    assert (done.returncode, done.stderr) == (0, "")
    last = json.loads(done.stdout.splitlines()[-1])
    assert last["event"] == "counters" and last["connections"] == 0


def test_the_first_step_says_which_sensors_are_wanted_and_where_it_connects(phone):
    events, answer = phone.step({"t": 40})
    wanted = {each["sensor"]: each["period_ms"] for each in events if each["event"] == "wants"}
    assert wanted.keys() >= SENSORS
    assert wanted["fix"] == 500 and wanted["pressure"] == wanted["rotation"] == 200
    (connect,) = answer["net"]
    assert connect[0] == "connect" and connect[2:4] == ["127.0.0.1", 50001]
    assert answer["due"] > 40


def sent(answer):
    return "".join(each[2] for each in answer["net"] if each[0] == "write")


def test_readings_leave_by_the_connection_that_the_simulator_made(phone):
    *_, answer = phone.step({"t": 0})
    number = answer["net"][0][1]
    phone.step({"t": 1, "net": [["connected", number]]})
    *_, answer = phone.step({"t": 2, "battery": 87, "pressure": 1013.25})
    messages = [json.loads(line) for line in sent(answer).splitlines()]
    assert {each["name"] for each in messages} == {"android.battery", "up.altitude.change"}
    by_name = {each["name"]: each["data"] for each in messages}
    assert by_name["android.battery"] == {"level": 87}
    assert by_name["up.altitude.change"]["altitude"] == pytest.approx(0.0, abs=0.01)


def test_what_is_said_to_it_comes_out_as_an_event_and_is_answered(phone):
    *_, answer = phone.step({"t": 0})
    number = answer["net"][0][1]
    phone.step({"t": 1, "net": [["connected", number]]})
    speak = '{"name": "android.speak", "data": {"text": "h\\u00e9 ho"}, "id": "7"}\n'
    half = len(speak) // 2
    phone.step({"t": 2, "net": [["bytes", number, speak[:half]]]})
    events, answer = phone.step({"t": 3, "net": [["bytes", number, speak[half:]]]})
    assert {"event": "says", "text": "hé ho"} in events
    assert {"name": "up.ack", "data": {"id": "7"}, "id": None} in map(
        json.loads, sent(answer).splitlines()
    )


def test_a_connection_that_is_full_keeps_the_newest_only(phone):
    *_, answer = phone.step({"t": 0})
    number = answer["net"][0][1]
    phone.step({"t": 1, "net": [["connected", number]]})
    at, text, full_at = 1, "", None
    while full_at is None or at < full_at + 10:
        at += 1
        *_, answer = phone.step({"t": at * 200, "pressure": 900.0 + at / 10})
        text += sent(answer)
        if ["full", number] in answer["net"]:
            full_at = at
    assert len(text) == 8192
    *_, answer = phone.step({"t": at * 200, "net": [["room", number, 8192]]})
    text += sent(answer)
    lines = text.split("\n")
    assert lines.pop() == ""
    # Half a line was under way and is finished; of the ten after it only the newest leaves.
    assert len(lines) == full_at - 1 + 1
    altitudes = [json.loads(line)["data"]["altitude"] for line in lines]
    assert altitudes == sorted(altitudes, reverse=True)


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ({}, "a line has no time 't'"),
        ({"t": 50}, "time went back by 50 ms"),
        ({"t": 100, "net": 3}, "net is no list"),
        ({"t": 100, "net": [["sing", 1]]}, "net: there is no event 'sing'"),
        ({"t": 100, "net": [["bytes"]]}, "net: an event is too short"),
        ({"t": 100, "net": [["bytes", "x", 1]]}, "net: an event is not understood"),
        ({"t": 100, "pressure": "x"}, "pressure is no number"),
        ({"t": 100, "rotation": [0, 0, 0]}, "rotation is no list of 4 numbers"),
        ({"t": 100, "rotation": [0, 0, 0, 0]}, "rotation: no rotation"),
        ({"t": 100, "fix": {"latitude": 50}}, "fix.longitude is no number"),
        ({"t": 100, "record": 1}, "record is no object"),
        ({"t": 100, "level": "TAIL"}, "not calibrated: "),
    ],
)
def test_a_wrong_line_is_told_and_ends_nothing(phone, line, sentence):
    phone.step({"t": 100})
    events, answer = phone.step(line)
    told = [each["text"] for each in events if each["event"] == "notice"]
    assert any(each.startswith(sentence) for each in told), told
    assert "due" in answer
    assert phone.step({"t": 101})[1]


def test_a_line_that_is_no_json_is_told_and_ends_nothing(program):
    done = run(program, *PLACE, "--stepped", text='nonsense\n{"t": 5}\n[]\n')
    assert (done.returncode, done.stderr) == (0, "")
    said = [json.loads(line) for line in done.stdout.splitlines()]
    assert sum("due" in each for each in said) == 3
    assert sum("no JSON" in each.get("text", "") for each in said) == 2


def test_a_closed_connection_is_a_sentence_and_is_tried_again(phone):
    *_, answer = phone.step({"t": 0})
    number = answer["net"][0][1]
    events, answer = phone.step({"t": 5, "net": [["closed", number, "nobody is there"]]})
    assert any("nobody is there" in each.get("text", "") for each in events)
    again_ms = answer["due"]
    assert 5 < again_ms <= 5 + 600
    *_, answer = phone.step({"t": again_ms})
    (connect,) = [each for each in answer["net"] if each[0] == "connect"]
    assert connect[1] != number
