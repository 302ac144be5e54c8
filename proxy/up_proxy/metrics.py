"""The metrics of the proxy, in the Prometheus text exposition format, version 0.0.4."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

import psutil

from up.protocols.proxy_lines import Side
from up_proxy.acceptor import Acceptor
from up_proxy.aircraft import AircraftSession
from up_proxy.loop_tick import LoopTick
from up_proxy.registry import AircraftRegistry
from up_proxy.tenant_quota import TenantQuota

Samples = list[tuple[Mapping[str, str], float]]
"""Labels and value of each sample."""
Row = tuple[str, str, Samples]
"""Name without its prefix, help, samples."""
Metric = tuple[str, str, str, Samples]
"""Name, kind (`counter` or `gauge`), help in one line, samples."""


def render(
    acceptors: Sequence[Acceptor],
    registry: AircraftRegistry,
    tick: LoopTick,
    now_s: float,
    more: Iterable[Metric] = (),
) -> str:
    """Return the page: ports, sums since the start, connected aircraft, process."""
    present = registry.aircraft()
    totals = registry.totals()

    sides = {side: [each for each in acceptors if each.side is side] for side in Side}

    def by_side(airborne: float, on_ground: float) -> Samples:
        return [({"side": "airborne"}, airborne), ({"side": "ground"}, on_ground)]

    def ports(counter: str) -> Samples:
        return by_side(*(sum(getattr(each, counter) for each in sides[side]) for side in Side))

    def each(of: Callable[[AircraftSession], float]) -> Samples:
        return [({"aircraft": craft.name}, of(craft)) for craft in present]

    connections = by_side(*(sum(len(each.connections) for each in sides[side]) for side in Side))
    refused = _by_code(sides, lambda each: each.refused)
    tls_failed = _by_code(sides, lambda each: {} if each.tls is None else each.tls.failed)
    received = by_side(totals.air_bytes, totals.ground_bytes)
    aircraft_received: Samples = [
        ({"aircraft": craft.name, "side": side}, count)
        for craft in present
        for side, count in (("airborne", craft.air_bytes), ("ground", craft.ground_bytes))
    ]
    online = each(lambda craft: int(craft.is_online(now_s)))
    commanded = each(lambda craft: int(craft.grounds.lease.live_owner(now_s) is not None))
    grounds = each(lambda craft: len(craft.grounds.connections))
    dropped, rejected = one(totals.dropped_lines), one(totals.rejected_lines)
    counters: list[Row] = [
        ("accepted", "Accepted connections.", ports("accepted")),
        ("over_limit", "Connections closed because of a limit.", ports("over_limit")),
        ("idle_closed", "Closed idle connections.", ports("idle_closed")),
        ("refused", "Refused connections, by code.", refused),
        ("tls_failed", "Failed TLS handshakes, by code.", tls_failed),
        ("bytes", "Bytes received from a side.", received),
        ("dropped_lines", "Old lines to slow grounds that newer ones replaced.", dropped),
        ("rejected_lines", "Lines from grounds without control or to no aircraft.", rejected),
        ("aircraft_bytes", "Bytes received, by aircraft and side.", aircraft_received),
    ]
    gauges: list[Row] = [
        ("connections", "Open connections.", connections),
        ("aircraft", "Aircraft with at least one connection.", one(len(registry))),
        ("aircraft_online", "1 while the airborne side is alive.", online),
        ("aircraft_commanded", "1 while a ground has control.", commanded),
        ("aircraft_grounds", "Connected grounds.", grounds),
        ("aircraft_queue_bytes", "Bytes waiting for slow peers.", each(_waiting_bytes)),
        ("uptime_seconds", "Time since the start.", one(tick.uptime_s)),
        ("loop_lag_seconds", "Lateness of the last tick.", one(tick.lag_s)),
        ("loop_lag_max_seconds", "Maximum lateness in a minute.", one(tick.lag_max_s)),
    ]
    resident = (
        "process_resident_memory_bytes",
        "gauge",
        "Resident memory.",
        one(psutil.Process().memory_info().rss),
    )
    return page([*named("up_proxy", counters, gauges), resident, *more])


def named(prefix: str, counters: Iterable[Row], gauges: Iterable[Row]) -> Iterator[Metric]:
    """Yield the metrics of some rows under their whole names."""
    for name, text, values in counters:
        yield f"{prefix}_{name}_total", "counter", text, values
    for name, text, values in gauges:
        yield f"{prefix}_{name}", "gauge", text, values


def one(value: float) -> Samples:
    """Return the only sample of a metric without labels."""
    return [({}, value)]


def quota_metrics(quota: TenantQuota) -> list[Metric]:
    """Return what the tenant uses at all nodes, and the quotas that are set."""
    used: Samples = [({"kind": kind}, count) for kind, count in quota.used()._asdict().items()]
    limits: Samples = [({"kind": kind}, limit) for kind, limit in quota.limits.items()]
    return [
        ("up_proxy_tenant_usage", "gauge", "Usage of the tenant at all nodes, by kind.", used),
        ("up_proxy_tenant_quota", "gauge", "Quotas of the tenant that are set.", limits),
    ]


def _by_code(
    sides: Mapping[Side, Iterable[Acceptor]], of: Callable[[Acceptor], Mapping[str, int]]
) -> Samples:
    counts: Counter[tuple[str, str]] = Counter()
    for side, acceptors in sides.items():
        for each in acceptors:
            counts.update({(side.value, code): count for code, count in of(each).items()})
    return [({"side": side, "code": code}, count) for (side, code), count in counts.items()]


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
