"""The figures of the runner for Prometheus."""

from __future__ import annotations

from collections.abc import Iterator

from up.system.figures import Figure
from up_runner.instance_machine import State
from up_runner.instances import Instances
from up_runner.request_server import RequestServer


def figures_of(instances: Instances, server: RequestServer) -> Iterator[Figure]:
    """Yield the states of the instances, and the counters of the request port."""
    states = instances.states()
    for state in State:
        text = "Instances by state."
        count = sum(each is state for each in states.values())
        yield Figure("up_runner_instances", text, count, {"state": state.name.lower()})
    for name, each in states.items():
        text = "1 while the instance of an aircraft runs."
        yield Figure("up_runner_running", text, each is State.RUNNING, {"aircraft": name})
    yield Figure("up_runner_connections", "Open connections of the request port.", len(server))
    for reason, count in server.counts.items():
        text = "Rejected connections and requests, by reason."
        yield Figure("up_runner_rejected", text, count, {"reason": reason}, "counter")
