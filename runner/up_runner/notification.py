"""The notifications of an instance: sd_notify datagrams with two fields of our own."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

MAX_BYTES = 4096
_PORT = re.compile(r"([a-z][a-z0-9_]{0,31}):([1-9][0-9]{0,4})", re.ASCII)
_MAX_PORTS = 16
_MAX_STATUS = 200


@dataclass(frozen=True, slots=True)
class Notification:
    """One datagram; a missing field is None or False.

    `ports` are TCP or UDP ports by purpose, `phone`: the phone is connected.
    """

    ready: bool = False
    alive: bool = False
    stopping: bool = False
    status: str | None = None
    ports: Mapping[str, int] | None = None
    phone: bool | None = None


def parse(datagram: bytes) -> Notification:
    """Parse a datagram; unknown or malformed fields are left out.

    Source: sd_notify(3) for READY, WATCHDOG, STOPPING and STATUS; X_UP_PORTS and X_UP_PHONE are
    ours. Never raises.
    """
    words: dict[str, str] = {}
    for line in datagram[:MAX_BYTES].decode("utf-8", "replace").split("\n"):
        name, equals, value = line.partition("=")
        if equals:
            words[name] = value
    return Notification(
        ready=words.get("READY") == "1",
        alive=words.get("WATCHDOG") == "1",
        stopping=words.get("STOPPING") == "1",
        status=_status(words.get("STATUS")),
        ports=_ports(words.get("X_UP_PORTS")),
        phone={"1": True, "0": False}.get(words.get("X_UP_PHONE", "")),
    )


def _status(text: str | None) -> str | None:
    if text is None:
        return None
    return "".join(letter if letter.isprintable() else "?" for letter in text[:_MAX_STATUS])


def _ports(text: str | None) -> dict[str, int] | None:
    if text is None:
        return None
    ports: dict[str, int] = {}
    for word in text.split():
        match = _PORT.fullmatch(word)
        if match is None or int(match[2]) > 65535 or len(ports) == _MAX_PORTS:
            return None
        ports[match[1]] = int(match[2])
    return ports
