"""What `up-fleet` makes a runner do: report, drain, stop an instance."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import psutil

from up_cluster.membership import usage_of
from up_runner.instances import Instances
from up_runner.pool.hosted import MOVING
from up_runner.pool.placement import RunnerInfo
from up_runner.response import Problem

KICKED = Problem("kicked", "it was stopped by up-fleet")


def report(info: RunnerInfo, instances: Instances) -> dict[str, Any]:
    """Return what a runner is, and what it and its instances use."""
    return {
        "kind": "runner",
        "host": info.host,
        "free": info.free,
        "labels": sorted(info.labels),
        "aircraft": list(_rows(instances)),
        **usage_of(psutil.Process()),
    }


def _rows(instances: Instances) -> Iterator[dict[str, Any]]:
    for name, state in instances.states().items():
        instance = instances.get(name)
        row: dict[str, Any] = {"aircraft": name, "state": state.name.lower()}
        if instance is not None and instance.pid is not None:
            row |= {"pid": instance.pid, "ports": instance.ports, "phone": instance.phone}
            with suppress(psutil.Error):
                row |= usage_of(psutil.Process(instance.pid))
        yield row


def drain(instances: Instances) -> dict[str, Any]:
    """Let the instances move."""
    names = list(instances.states())
    for name in names:
        instance = instances.get(name)
        if instance is not None:
            instance.stop(MOVING)
    return {"leaving": names}


def kick(instances: Instances, message: dict[str, Any]) -> dict[str, Any]:
    """Stop the instance that a message names."""
    instance = instances.get(str(message.get("aircraft")))
    if instance is None:
        return {"code": "unknown_aircraft"}
    instance.stop(KICKED)
    return {"stopping": instance.name}
