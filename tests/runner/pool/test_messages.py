import contextlib
import json
import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from up_runner.pool.messages import decode_response, encode_response
from up_runner.request import MalformedRequest, Request, decode_request, encode_request
from up_runner.response import Problem, Response

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
