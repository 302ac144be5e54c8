"""The metrics of the proxy, in the Prometheus text exposition format, version 0.0.4."""

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from up_proxy.acceptor import Acceptor
from up_proxy.aircraft import AircraftSession
from up_proxy.loop_tick import LoopTick
from up_proxy.registry import AircraftRegistry

CONTENT_TYPE = "text/plain; version=0.0.4; charset=utf-8"

Samples = list[tuple[Mapping[str, str], float]]
"""Labels and value of each sample."""
Metric = tuple[str, str, str, Samples]
"""Name, kind (`counter` or `gauge`), help in one line, samples."""


def render(
    air: Acceptor, ground: Acceptor, registry: AircraftRegistry, tick: LoopTick, now_s: float
) -> str:
    """Return the page: ports, sums since the start, connected aircraft, process."""
    present = registry.aircraft()
    totals = registry.totals()

    def by_side(airborne: float, on_ground: float) -> Samples:
        return [({"side": "airborne"}, airborne), ({"side": "ground"}, on_ground)]

    def ports(of: Callable[[Acceptor], float]) -> Samples:
        return by_side(of(air), of(ground))

    def each(of: Callable[[AircraftSession], float]) -> Samples:
        return [({"aircraft": craft.name}, of(craft)) for craft in present]

    refused: Samples = [
        ({"side": side, "code": code}, count)
        for side, acceptor in (("airborne", air), ("ground", ground))
        for code, count in acceptor.refused.items()
    ]
    aircraft_bytes: Samples = [
        ({"aircraft": craft.name, "side": side}, count)
        for craft in present
        for side, count in (("airborne", craft.air_bytes), ("ground", craft.ground_bytes))
    ]
    metrics: list[Metric] = [
        ("connections", "gauge", "Open connections.", ports(lambda port: len(port.connections))),
        ("accepted_total", "counter", "Accepted connections.", ports(lambda port: port.accepted)),
        (
            "over_limit_total",
            "counter",
            "Connections closed because of a limit.",
            ports(lambda port: port.over_limit),
        ),
        (
            "idle_closed_total",
            "counter",
            "Closed idle connections.",
            ports(lambda port: port.idle_closed),
        ),
        ("refused_total", "counter", "Refused connections, by code.", refused),
        ("aircraft", "gauge", "Aircraft with at least one connection.", [({}, len(registry))]),
        (
            "bytes_total",
            "counter",
            "Bytes received from a side.",
            by_side(totals.air_bytes, totals.ground_bytes),
        ),
        (
            "dropped_lines_total",
            "counter",
            "Old lines to slow grounds that newer ones replaced.",
            [({}, totals.dropped_lines)],
        ),
        (
            "rejected_lines_total",
            "counter",
            "Lines from grounds without control or for an absent aircraft.",
            [({}, totals.rejected_lines)],
        ),
        (
            "aircraft_online",
            "gauge",
            "1 while the airborne side is alive.",
            each(lambda craft: int(craft.is_online(now_s))),
        ),
        (
            "aircraft_commanded",
            "gauge",
            "1 while a ground has control.",
            each(lambda craft: int(craft.grounds.lease.live_owner(now_s) is not None)),
        ),
        (
            "aircraft_grounds",
            "gauge",
            "Connected grounds.",
            each(lambda craft: len(craft.grounds.connections)),
        ),
        ("aircraft_queue_bytes", "gauge", "Bytes waiting for slow peers.", each(_waiting_bytes)),
        (
            "aircraft_bytes_total",
            "counter",
            "Bytes received, by aircraft and side.",
            aircraft_bytes,
        ),
        ("uptime_seconds", "gauge", "Time since the start.", [({}, tick.uptime_s)]),
        (
            "loop_lag_seconds",
            "gauge",
            "Lateness of the event loop's last tick.",
            [({}, tick.lag_s)],
        ),
        (
            "loop_lag_max_seconds",
            "gauge",
            "Maximum lateness of the event loop in the last minute.",
            [({}, tick.lag_max_s)],
        ),
    ]
    resident: Metric = (
        "process_resident_memory_bytes",
        "gauge",
        "Resident memory.",
        [({}, resident_bytes())],
    )
    named = [("up_proxy_" + name, kind, text, samples) for name, kind, text, samples in metrics]
    return page([*named, resident])


def page(metrics: Iterable[Metric]) -> str:
    """Return the text of some metrics."""
    lines: list[str] = []
    for name, kind, text, samples in metrics:
        lines += [f"# HELP {name} {text}", f"# TYPE {name} {kind}"]
        for labels, value in samples:
            shown = ",".join(f'{key}="{_escape(label)}"' for key, label in labels.items())
            lines.append(f"{name}{{{shown}}} {value!r}" if shown else f"{name} {value!r}")
    return "\n".join(lines) + "\n"


def _escape(text: str) -> str:
    return text.replace("\\", "\\\\").replace("\n", "\\n").replace('"', '\\"')


def _waiting_bytes(craft: AircraftSession) -> int:
    peers = (craft.air_lease.owner, *craft.grounds.connections)
    return sum(peer.waiting_bytes for peer in peers if peer is not None)


def resident_bytes() -> int:
    """Return this process's resident memory; 0 without /proc."""
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    except (OSError, ValueError, IndexError):
        return 0
    return pages * os.sysconf("SC_PAGE_SIZE")
