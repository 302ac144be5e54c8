"""Answers: the prototype's words and the truth."""

import json

from up_runner.answer import Answer


def test_the_example_of_the_protocol_page_byte_for_byte():
    answer = Answer("glider-1", 4242, {"general": 50001, "orientation": 50000}, spawned=True)
    proxy = {"host": "proxy.example", "airborne": 3003, "ground": 3004}
    assert answer.encode("203.0.113.9", proxy) == (
        b'{"message": "Raspilot spawned", "spawned": true, "error": null, '
        b'"myAddress": "203.0.113.9", "running": true, "pid": 4242, "instance": "glider-1", '
        b'"ports": {"general": 50001, "orientation": 50000}, '
        b'"proxy": {"host": "proxy.example", "airborne": 3003, "ground": 3004}}\n'
    )


def test_a_failure_is_never_called_spawned():
    answer = json.loads(Answer("a", error="x\ny é").encode("127.0.0.1", None))
    assert answer["message"] == "Raspilot not running"
    assert answer["spawned"] is answer["running"] is False
    assert answer["pid"] is answer["ports"] is answer["proxy"] is None


def test_what_ran_before_is_not_called_spawned():
    assert Answer("a", 1, {}).message == "Raspilot already running"


def test_an_answer_is_one_line():
    line = Answer("a", error="one\ntwo\u2028three").encode("::1", None)
    assert line.count(b"\n") == 1 and line.endswith(b"\n") and line.isascii()
