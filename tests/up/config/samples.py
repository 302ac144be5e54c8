"""A configuration that uses everything that can be declared."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from up.config import ConfigErrors, ConfigFile, items, key, mapping, section
from up.fields import Constraint

PATH = Path("link.yml")


@dataclass(frozen=True, slots=True)
class Remote:
    """Where the ground station proxy is."""

    url: str = key("", "Host name or address; empty: no remote server.", max_length=255)
    port: int = key(3003, "TCP port of the proxy's airborne side.", minimum=1, maximum=65535)


@dataclass(frozen=True, slots=True)
class Gains:
    """The gains of one axis."""

    p: float = key(0.7, "Proportional.", minimum=0, maximum=50)
    i: float = key(0.0, "Integral.", minimum=0, maximum=50)


@dataclass(frozen=True, slots=True)
class Thresholds:
    """When to panic."""

    panic: float = key(80.0, "Enter at.", unit="%", minimum=0, maximum=100)
    calm: float = key(65.0, "Leave at.", name="calm down", unit="%", minimum=0, maximum=100)

    def problems(self):
        if self.calm >= self.panic:
            yield "calm", "must be below panic"


@dataclass(frozen=True, slots=True)
class Link:
    """The link to the ground station.

    It is looked for again and again.
    """

    remote_server: Remote = section(Remote)
    role: str = key(
        "operator", "What a ground station may do.", choices=("observer", "operator", "pilot")
    )
    stop_delay_s: float = key(
        10.0,
        "How long to wait before stopping.",
        name="stop delay (s)",
        unit="s",
        minimum=0,
        maximum=3600,
        replaced=("stop delay (in seconds)",),
    )
    forward: bool = key(True, "Whether telemetry is forwarded to the phone.")
    name: str = key("default", "The aircraft.", max_length=20)
    limit: float | None = key(None, "No limit when null.", minimum=0)
    thresholds: Thresholds = section(Thresholds)
    spare: Remote | None = section(Remote, "Another proxy.", name="spare server", optional=True)
    gains: dict[str, Any] = mapping(
        Constraint(str, max_length=10), Gains, "Per axis.", default={"roll": Gains()}
    )
    labels: dict[str, Any] = mapping(Constraint(str), Constraint(int, 0, 9), "Numbers by name.")
    hosts: tuple[str, ...] = items(
        Constraint(str), "Who may connect.", default=("127.0.0.1", "::1"), max_length=5
    )


LINK = ConfigFile(
    "link.yml",
    Link,
    removed={
        "port": "write 'remote_server: {port: ...}'",
        "remote_server.host": "write 'url' instead",
    },
)


def problems_of(text, file=LINK):
    """Return the problems of a text as 'line:column code key'."""
    with pytest.raises(ConfigErrors) as caught:
        file.parse(text, PATH)
    return [places(problem) for problem in caught.value.problems]


def places(problem):
    return f"{problem.line}:{problem.column} {problem.code} {problem.key}".strip()
