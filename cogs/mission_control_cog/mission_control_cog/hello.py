"""The first line of the link to the proxy, and its answer (docs/protocols.md 9)."""

from __future__ import annotations

import re
from dataclasses import dataclass

HELLO_MAX_BYTES = 512
PREFIX = b"UP1 "

_OK = re.compile(rb"UP1 ok (?P<words>.*)")
_ERROR = re.compile(rb'UP1 error code=(?P<code>[a-z]{1,32}) reason="(?P<reason>[^"]*)".*')
_TOKEN = re.compile(r"[0-9a-f]{32,64}")


@dataclass(frozen=True, slots=True)
class HelloAnswer:
    """The answer of the proxy: ``error`` is empty when it accepted the aircraft."""

    token: str = ""
    error: str = ""
    reason: str = ""


def hello_line(aircraft: str, token: str) -> bytes:
    """Return the hello line; with the token of the last link, if there is one."""
    words = f"UP1 aircraft={aircraft}" + (f" token={token}" if token else "")
    return words.encode("ascii") + b"\n"


def parse_answer(line: bytes) -> HelloAnswer | None:
    """Parse the answer to a hello; None if the line is not one."""
    line = line.removesuffix(b"\r")
    error = _ERROR.fullmatch(line)
    if error is not None:
        return HelloAnswer(
            error=error["code"].decode("ascii"), reason=error["reason"].decode("ascii", "replace")
        )
    accepted = _OK.fullmatch(line)
    if accepted is None:
        return None
    words = dict(
        word.partition("=")[::2] for word in accepted["words"].decode("ascii", "replace").split(" ")
    )
    token = words.get("token", "")
    return HelloAnswer(token=token if _TOKEN.fullmatch(token) else "")
