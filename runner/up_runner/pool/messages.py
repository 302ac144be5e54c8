"""What a runner of a pool answers another one about a phone's request, as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from up_runner.response import Problem, Response

ELSEWHERE, NO_ANSWER = "elsewhere", "no_answer"


def encode_response(response: Response) -> dict[str, Any]:
    """Return the fields of a response."""
    return {
        "pid": response.pid,
        "ports": None if response.ports is None else dict(response.ports),
        "spawned": response.spawned,
        "host": response.host,
        "code": response.error.code if response.error is not None else None,
        "text": response.error.text if response.error is not None else None,
    }


def decode_response(aircraft: str, fields: Mapping[str, Any]) -> Response:
    """Return a response; malformed fields give one with `no_answer`."""
    try:
        code, ports = fields["code"], fields["ports"]
        return Response(
            aircraft,
            None if fields["pid"] is None else int(fields["pid"]),
            None if ports is None else {str(name): int(port) for name, port in ports.items()},
            fields["spawned"] is True,
            None if code is None else Problem(str(code), str(fields["text"])),
            str(fields["host"]),
        )
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError):
        return failed(aircraft, NO_ANSWER, "the runner of this aircraft gave a malformed answer")


def failed(aircraft: str, code: str, text: str) -> Response:
    """Return the response for an instance that does not run for a reason of the pool."""
    return Response(aircraft, error=Problem(code, text))
