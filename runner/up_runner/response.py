"""The runner's response: one JSON line (docs/protocols.md, section 8)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class Problem:
    """Why an instance does not run, or a request is refused: a code and one sentence."""

    code: str
    text: str

    def __str__(self) -> str:
        return self.text


NO_ANSWER = "no_answer"
BUG = Problem("runner_bug", "the runner failed, see its log")


@dataclass(frozen=True, slots=True)
class Response:
    """The state of one instance at the moment of the response.

    `spawned` is true only if this request started the running process. `pid`, `ports`: None without
    a process. `host`: where a pool runs the instance, empty without a pool.
    """

    instance: str | None
    pid: int | None = None
    ports: Mapping[str, int] | None = None
    spawned: bool = False
    error: Problem | None = None
    host: str = ""

    @property
    def running(self) -> bool:
        """Return whether the instance runs with its ports bound."""
        return self.pid is not None

    @property
    def message(self) -> str:
        """Return the prototype's message."""
        if not self.running:
            return "Raspilot not running"
        return "Raspilot spawned" if self.spawned else "Raspilot already running"

    def encode(self, my_address: str, proxy: Mapping[str, object] | None) -> bytes:
        """Return the line for a client that reaches us at `my_address`, with its line feed."""
        response = {
            "message": self.message,
            "spawned": self.spawned,
            "error": self.error and self.error.text,
            "myAddress": my_address,
            "running": self.running,
            "pid": self.pid,
            "instance": self.instance,
            "ports": None if self.ports is None else dict(self.ports),
            "proxy": proxy,
            "code": self.error and self.error.code,
            **({"host": self.host} if self.host else {}),
        }
        return json.dumps(response, ensure_ascii=True, allow_nan=False).encode("ascii") + b"\n"


def encode_response(response: Response) -> dict[str, Any]:
    """Return the fields of a response for another runner of a pool."""
    return {
        "pid": response.pid,
        "ports": None if response.ports is None else dict(response.ports),
        "spawned": response.spawned,
        "host": response.host,
        "code": response.error and response.error.code,
        "text": response.error and response.error.text,
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


def failed(aircraft: str | None, code: str, text: str) -> Response:
    """Return the response for an instance that does not run."""
    return Response(aircraft, error=Problem(code, text))
