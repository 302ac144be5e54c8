"""What `up-fleet` makes a runner do: report, drain, stop an instance."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import psutil

from up_cluster.membership import Action, usage_of
from up_runner.instances import Instances
from up_runner.pool.hosted import MOVING
from up_runner.pool.placement import RunnerInfo
from up_runner.response import Problem

KICKED = Problem("kicked", "it was stopped by up-fleet")


class FleetActions:
    """`info` describes the runner; `beat` tells the others about a change of it.

    `shares`: the tenant's usage and quota.
    """

    def __init__(
        self,
        instances: Instances,
        info: Callable[[], RunnerInfo],
        beat: Callable[[], None],
        shares: Callable[[], dict[str, dict[str, int]]],
    ) -> None:
        self._instances = instances
        self._info = info
        self._beat = beat
        self._shares = shares
        self.is_draining = False
        self.actions: dict[str, Action] = {
            "report": self._report,
            "drain": self._drain,
            "kick": self._kick,
        }

    def _report(self, message: dict[str, Any]) -> dict[str, Any]:
        info = self._info()
        return {
            "kind": "runner",
            "host": info.host,
            "is_draining": self.is_draining,
            "free": info.free,
            "labels": sorted(info.labels),
            "aircraft": list(self._rows()),
            **self._shares(),
            **usage_of(psutil.Process()),
        }

    def _rows(self) -> Iterator[dict[str, Any]]:
        for name, state in self._instances.states().items():
            instance = self._instances.get(name)
            row: dict[str, Any] = {"aircraft": name, "state": state.name.lower()}
            if instance is not None and instance.pid is not None:
                row |= {"pid": instance.pid, "ports": instance.ports, "phone": instance.phone}
                with suppress(psutil.Error):
                    row |= usage_of(psutil.Process(instance.pid))
            yield row

    def _drain(self, message: dict[str, Any]) -> dict[str, Any]:
        """Start nothing here again, and let the instances move."""
        self.is_draining = True
        self._beat()
        names = list(self._instances.states())
        for name in names:
            instance = self._instances.get(name)
            if instance is not None:
                instance.stop(MOVING)
        return {"leaving": names}

    def _kick(self, message: dict[str, Any]) -> dict[str, Any]:
        instance = self._instances.get(str(message.get("aircraft")))
        if instance is None:
            return {"code": "unknown_aircraft"}
        instance.stop(KICKED)
        return {"stopping": instance.name}
