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
    """What the proxy said: ``error`` is empty when the aircraft was taken in."""

    token: str = ""
    error: str = ""
    reason: str = ""


def hello_line(aircraft: str, token: str) -> bytes:
    """Return the line that says who this is; with the token of the last link, where there is."""
    words = f"UP1 aircraft={aircraft}" + (f" token={token}" if token else "")
    return words.encode("ascii") + b"\n"


def parse_answer(line: bytes) -> HelloAnswer | None:
    """Return what the answer to a hello says; None when the line is no such answer."""
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
