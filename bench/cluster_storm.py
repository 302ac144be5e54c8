"""Aircraft of a storm, a separate process; its argument is JSON: hosts, ports, count.

Prints how many are connected, each 0.1 s.
"""

import json
import sys
from types import SimpleNamespace
from typing import Any

from tests.proxy.cluster.traffic import Traffic
from tests.support.reactor import reactor

PERIOD_S = 5.0
"""Of frames; an aircraft without grounds may be silent for longer."""
REPORT_S = 0.1


class Nodes:
    """The relays that run already."""

    def __init__(self, hosts: list[str], ports: list[int]) -> None:
        self.host = hosts.__getitem__
        self.programs = [SimpleNamespace(airborne_port=port) for port in ports]


def main(job: dict[str, Any]) -> None:
    traffic = Traffic(Nodes(job["hosts"], job["ports"]), PERIOD_S)
    for number in range(job["count"]):
        traffic.add_aircraft(number % len(job["ports"]), f"storm-{number}")

    def report() -> None:
        print(sum(each.is_open for each in traffic.aircraft), flush=True)
        reactor.callLater(REPORT_S, report)

    report()
    reactor.run()


if __name__ == "__main__":
    main(json.loads(sys.argv[1]))
