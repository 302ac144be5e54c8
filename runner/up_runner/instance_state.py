"""The state of an instance that a runner saves for the next one."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import Any

from up.quick_dataclass import dataclass
from up_runner.process import Identity
from up_runner.request import MalformedRequest, Request, decode_request, encode_request

NAME = "state.json"
_VERSION = 1


@dataclass(frozen=True, slots=True)
class InstanceState:
    """An instance's last known state.

    `identity`: None between two processes, while a restart is pending. `keep`: it must be
    restarted when it is gone; `ready`: its ports were bound. `phone`: None until the instance has
    reported whether its phone is connected.
    """

    request: Request
    identity: Identity | None = None
    keep: bool = False
    ready: bool = False
    ports: dict[str, int] | None = None
    phone: bool | None = None

    def save(self, folder: Path) -> None:
        """Write it into the instance's folder atomically; raises OSError."""
        # Not synced: a power cut ends the processes anyway, and a slow disk must not block the
        # reactor.
        temporary = folder / f".{NAME}.tmp"
        temporary.write_text(json.dumps(self._as_json(), indent=1, allow_nan=False) + "\n")
        temporary.replace(folder / NAME)

    def _as_json(self) -> dict[str, Any]:
        who = self.identity
        return {
            "version": _VERSION,
            **encode_request(self.request),
            "process": who and [who.pid, who.start_ticks, who.boot_id],
            "keep": self.keep,
            "ready": self.ready,
            "ports": self.ports,
            "phone": self.phone,
        }


def load(folder: Path) -> InstanceState | None:
    """Return the state saved in an instance's folder; None without a valid one."""
    try:
        found = json.loads((folder / NAME).read_text("utf-8"))
        if found["version"] != _VERSION:
            return None
        request = decode_request(found)
        if request.aircraft != folder.name:
            return None
        who, ports = found["process"], found["ports"]
        return InstanceState(
            request=request,
            identity=None if who is None else Identity(int(who[0]), int(who[1]), str(who[2])),
            keep=bool(found["keep"]),
            ready=bool(found["ready"]),
            ports=None if ports is None else {str(name): int(p) for name, p in ports.items()},
            phone=None if found["phone"] is None else bool(found["phone"]),
        )
    except (OSError, ValueError, KeyError, TypeError, IndexError, AttributeError, MalformedRequest):
        # A broken file is ignored; the processes still show which instances live.
        return None


def discard(folder: Path) -> None:
    """Remove the saved state: the instance ended and must not restart."""
    with contextlib.suppress(OSError):
        (folder / NAME).unlink()
