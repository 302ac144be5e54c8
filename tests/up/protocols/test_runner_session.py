"""A protected request to a runner: every byte of its lines, and what a client believes."""

import json
from pathlib import Path

import pytest

from tests.up.protocols.test_envelope import KEY, Drawn
from up.protocols.aircraft_sessions import AircraftSessions
from up.protocols.envelope import EnvelopeError
from up.protocols.pairing import Pairing
from up.protocols.runner_session import RUNNER, RunnerSession, body_of, to_line
from up.system.aircraft_name import AIRCRAFT_NAME

VECTORS = json.loads(Path("tests/vectors/runner_request.json").read_text(encoding="utf-8"))
PAIRING = Pairing("glider-1", KEY.id.hex(), KEY.secret.hex(), "pilot", "tablet")
REQUEST, RESULT = b'{"aircraft": "glider-1"}', b'{"running": true}'


def opened():
    """Return both ends, and the lines of one request."""
    client, runner = RunnerSession(PAIRING, Drawn(0x10)), AircraftSessions(RUNNER, int, Drawn(0x20))
    runner.replace_keys({KEY.id: KEY})
    hello = client.hello()
    session, answer = runner.answer(body_of(json.loads(hello)))
    request = client.request(to_line(answer), REQUEST)
    assert runner.open(body_of(json.loads(request))) == (session, REQUEST)
    lines = {"hello": hello, "answer": to_line(answer), "request": request}
    return client, runner, session, lines


def test_the_golden_vectors():
    client, runner, session, lines = opened()
    lines["result"] = to_line(session.answers.seal(RESULT))
    assert client.result(lines["result"]) == RESULT
    lines["refusal"] = to_line(runner.replace_keys({})[0][1][1])
    assert {name: line.decode() for name, line in lines.items()} == VECTORS["lines"]


def test_no_aircraft_can_have_the_runners_name():
    assert not AIRCRAFT_NAME.fullmatch(RUNNER)


@pytest.mark.parametrize(
    ("line", "code"),
    [
        (b'{"running": true, "ports": {}, "code": null}', "unprotected"),
        (b'{"running": false, "code": "instance_limit"}', "instance_limit"),
        (b'{"action": "protected", "body": "zz"}', "unprotected"),
        (b'{"action": "protected", "body": "02"}', "malformed"),
        (b"[]", "malformed"),
        (b"[" * 10_000, "malformed"),
        (VECTORS["lines"]["answer"].encode(), "malformed"),
        (VECTORS["lines"]["request"].encode(), "forged"),
        (VECTORS["lines"]["result"].replace("7d", "7e").encode(), "forged"),
        (VECTORS["lines"]["refusal"].encode(), "unknown_key"),
    ],
)
def test_what_proves_nothing_is_refused_with_a_code(line, code):
    client, *_ = opened()
    with pytest.raises(EnvelopeError) as refused:
        client.result(line)
    assert refused.value.code == code
