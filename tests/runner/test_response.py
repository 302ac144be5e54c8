"""The line for a client: the prototype's message and the state of the instance."""

import json

from up_runner.response import Problem, Response


def test_the_example_of_the_protocol_page_byte_for_byte():
    response = Response("glider-1", 4242, {"general": 50001, "orientation": 50000}, spawned=True)
    proxy = {"host": "proxy.example", "airborne": 3003, "ground": 3004}
    assert response.encode("203.0.113.9", proxy) == (
        b'{"message": "Raspilot spawned", "spawned": true, "error": null, '
        b'"myAddress": "203.0.113.9", "running": true, "pid": 4242, "instance": "glider-1", '
        b'"ports": {"general": 50001, "orientation": 50000}, '
        b'"proxy": {"host": "proxy.example", "airborne": 3003, "ground": 3004}, "code": null}\n'
    )


def test_a_failure_is_one_line_and_never_called_spawned():
    line = Response("a", error=Problem("hung", "x\ny \u2028 \u00e9")).encode("::1", None)
    assert line.count(b"\n") == 1 and line.endswith(b"\n") and line.isascii()
    response = json.loads(line)
    assert response["message"] == "Raspilot not running"
    assert response["code"] == "hung"
    assert response["spawned"] is response["running"] is False
    assert response["pid"] is response["ports"] is response["proxy"] is None


def test_an_instance_that_ran_before_is_not_called_spawned():
    assert Response("a", 1, {}).message == "Raspilot already running"
