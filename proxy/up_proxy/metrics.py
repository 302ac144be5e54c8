"""The metrics of the proxy."""

import os
from collections.abc import Iterable
from pathlib import Path

from up_proxy.aircraft import Aircraft
from up_proxy.door import Door
from up_proxy.fleet import Fleet
from up_proxy.heartbeat import Heartbeat
from up_proxy.metrics_page import Metric, Sample

_PREFIX = "up_proxy_"


def resident_bytes() -> int:
    """Return this process's resident memory; 0 without /proc."""
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    except (OSError, ValueError, IndexError):
        return 0
    return pages * os.sysconf("SC_PAGE_SIZE")


def _one(name: str, kind: str, text: str, value: float) -> Metric:
    return Metric(_PREFIX + name, kind, text, (Sample(value),))


def _by_side(name: str, kind: str, text: str, air: float, ground: float) -> Metric:
    samples = (Sample(air, {"side": "airborne"}), Sample(ground, {"side": "ground"}))
    return Metric(_PREFIX + name, kind, text, samples)


def door_metrics(air: Door, ground: Door) -> Iterable[Metric]:
    """Yield the counters of the two ports."""
    yield _by_side(
        "connections", "gauge", "Open connections.", len(air.connections), len(ground.connections)
    )
    yield _by_side(
        "accepted_total", "counter", "Connections accepted.", air.accepted, ground.accepted
    )
    yield _by_side(
        "over_limit_total",
        "counter",
        "Connections closed because of a limit.",
        air.over_limit,
        ground.over_limit,
    )
    yield _by_side(
        "idle_closed_total", "counter", "Idle connections.", air.idle_closed, ground.idle_closed
    )
    yield Metric(
        _PREFIX + "refused_total",
        "counter",
        "Connections refused, by the code of the refusal.",
        tuple(
            Sample(count, {"side": side, "code": code})
            for side, door in (("airborne", air), ("ground", ground))
            for code, count in door.refused.items()
        ),
    )


def fleet_metrics(fleet: Fleet, now_s: float) -> Iterable[Metric]:
    """Yield the sums since the start, then the counters of each connected aircraft."""
    totals = fleet.totals()
    yield _one("aircraft", "gauge", "Aircraft that somebody is connected for.", len(fleet))
    yield _by_side(
        "bytes_total", "counter", "Bytes heard from a side.", totals.air_bytes, totals.ground_bytes
    )
    yield _one(
        "dropped_lines_total",
        "counter",
        "Old lines to slow grounds that newer ones displaced.",
        totals.dropped_lines,
    )
    yield _one(
        "unheard_lines_total",
        "counter",
        "Lines from grounds without the seat or for an absent aircraft.",
        totals.unheard_lines,
    )
    present = fleet.aircraft()

    def each(name: str, kind: str, text: str, values: Iterable[float]) -> Metric:
        pairs = zip(present, values, strict=True)
        samples = tuple(Sample(value, {"aircraft": craft.name}) for craft, value in pairs)
        return Metric(_PREFIX + name, kind, text, samples)

    yield each(
        "aircraft_online",
        "gauge",
        "1 while the airborne side is alive.",
        [int(craft.is_online(now_s)) for craft in present],
    )
    yield each(
        "aircraft_commanded",
        "gauge",
        "1 while a ground holds the seat that commands.",
        [int(craft.command_seat.holder(now_s) is not None) for craft in present],
    )
    yield each(
        "aircraft_grounds", "gauge", "Grounds, holder included.", [len(c.grounds) for c in present]
    )
    yield each(
        "aircraft_queue_bytes",
        "gauge",
        "Bytes that wait for slow peers.",
        [_waiting_bytes(craft) for craft in present],
    )
    yield Metric(
        _PREFIX + "aircraft_bytes_total",
        "counter",
        "Bytes heard, by aircraft and side.",
        tuple(
            Sample(count, {"aircraft": craft.name, "side": side})
            for craft in present
            for side, count in (("airborne", craft.air_bytes), ("ground", craft.ground_bytes))
        ),
    )


def _waiting_bytes(aircraft: Aircraft) -> int:
    air = aircraft.air_seat.occupant
    waiting = sum(ground.waiting_bytes for ground in aircraft.grounds)
    return waiting + (air.waiting_bytes if air is not None else 0)


def process_metrics(heartbeat: Heartbeat) -> Iterable[Metric]:
    """Yield the metrics of the process itself."""
    yield _one("uptime_seconds", "gauge", "Time since the start.", heartbeat.uptime_s)
    yield _one(
        "loop_lag_seconds",
        "gauge",
        "How late the event loop's last tick was.",
        heartbeat.lag_s,
    )
    yield _one(
        "loop_lag_max_seconds",
        "gauge",
        "How late the latest of the last ticks was.",
        heartbeat.lag_max_s,
    )
    yield Metric(
        "process_resident_memory_bytes", "gauge", "Resident memory.", (Sample(resident_bytes()),)
    )
