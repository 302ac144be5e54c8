"""The line for a client: the prototype's message and the state of the instance."""

import contextlib
import json
import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from up_runner.request import MalformedRequest, Request, decode_request, encode_request
from up_runner.response import Problem, Response, decode_response, encode_response


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


# Between the runners of a pool.

JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
)
FIELDS = ("pid", "ports", "spawned", "host", "code", "text")
NAMES = st.sampled_from([*FIELDS, "request", "key"])


def through_json(fields):
    return json.loads(json.dumps(fields))


def test_a_request_and_its_answer_arrive_as_they_were():
    settings = {"load_guard.yml": {"interval": 1.5}}
    request = Request("a.b-1", "cub", settings, labels=("eu", "gpu"), key="0a")
    assert decode_request(through_json(encode_request(request))) == request
    for response in (
        Response("a", 7, {"general": 1}, True, None, "10.0.0.1"),
        Response("a", error=Problem("instance_limit", "full")),
    ):
        assert decode_response("a", through_json(encode_response(response))) == response


@given(st.dictionaries(NAMES, JSON) | st.fixed_dictionaries(dict.fromkeys(FIELDS, JSON)))
@example({**dict.fromkeys(FIELDS), "pid": math.inf})
def test_any_fields_are_a_response(fields):
    response = decode_response("a", fields)
    assert response.pid is None or type(response.pid) is int
    with contextlib.suppress(MalformedRequest):
        decode_request(fields)


def test_a_malformed_answer_is_no_answer():
    assert decode_response("a", {"id": "x"}).error.code == "no_answer"
    with pytest.raises(MalformedRequest):
        decode_request({"request": {"aircraft": "../x"}})
