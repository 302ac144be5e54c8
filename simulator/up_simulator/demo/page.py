"""The ground station in a browser: a part of ``make run`` that no flight needs."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path

from up_ground.token_store import STATE_VARIABLE
from up_simulator.demo.hints import program, state_setting
from up_simulator.harness.child import Child
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.ports import Ports

LIMIT_S = 30.0


class Page:
    """``up-ground serve`` for the aircraft behind the proxy of a run.

    ``listen`` is its address, ``ADDRESS:PORT``, ``state`` the folder of its keys; its output is in
    ``page.log``. ``command`` is the shell command that starts it again.
    """

    def __init__(self, folder: Path, ports: Ports, state: Path, listen: str | None = None) -> None:
        (folder / "page.log").unlink(missing_ok=True)
        words = ["serve", "--port", str(ports.ground)]
        words += ["--listen", listen or f"127.0.0.1:{ports.page}"]
        command = [sys.executable, "-m", "up_ground.main", *words]
        environment = {STATE_VARIABLE: str(state)}
        self.child = Child("page", command, folder, environment=environment)
        self.command = f"{state_setting(state)} {program('up-ground')} {shlex.join(words)}"

    def wait_for_address(self) -> str | None:
        """Return the page's address; None when it has ended or reports none in time."""
        try:
            self.child.wait_for("ready", LIMIT_S)
            return str(self.child.wait_for("page_open", LIMIT_S).fields["url"])
        except ParticipantError:
            return None

    @property
    def notes(self) -> list[str]:
        """Return where its key is, and that a network may read it; nothing on loopback."""
        codes = ("page_key", "page_plain")
        return [line.text for line in self.child.lines() if line.code in codes]

    @property
    def reason(self) -> str:
        status = self.child.poll()
        if status is None:
            return f"no address within {LIMIT_S:.0f} s (its log: {self.child.log})"
        coded = [line.text for line in self.child.lines() if line.code]
        if coded and status >= 0:
            return coded[-1]
        how = f"signal {-status}" if status < 0 else f"status {status}"
        return f"it ended unexpectedly with {how} (its log: {self.child.log})"
