"""The figures of the ground station for Prometheus."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from up.system.figures import Figure
from up_ground.settings import Seat
from up_ground.web.aircraft_session import AircraftSession

if TYPE_CHECKING:
    from up_ground.web.client_hub import ClientHub

_COUNTERS = {
    "connections": "Connections made.",
    "malformed": "Lines that were no General Messages.",
    "too_long": "Lines that were too long.",
    "keyless": "Packed frames whose key was missing.",
    "refused": "Lines that the key does not authenticate.",
    "unprotected": "Plain lines on a link with a key, or protected ones without.",
}


def figures_of(hub: ClientHub) -> Iterator[Figure]:
    """Yield the state and the counters of each aircraft's link and telemetry, and the pages."""
    yield Figure("up_ground_pages", "Connected pages.", len(hub.all()))
    for aircraft in hub.fleet.values():
        if isinstance(aircraft, AircraftSession):
            yield from _of(aircraft)


def _of(aircraft: AircraftSession) -> Iterator[Figure]:
    status, telemetry = aircraft.link.status, aircraft.telemetry
    labels = {"aircraft": aircraft.name}

    def gauge(name: str, text: str, value: float) -> Figure:
        return Figure(f"up_ground_{name}", text, value, labels)

    def counter(name: str, text: str, value: float) -> Figure:
        return Figure(f"up_ground_{name}", text, value, labels, "counter")

    yield gauge("connected", "1 while the link is open.", status.is_open)
    if status.is_aircraft_online is not None:
        yield gauge("aircraft_online", "1 while it is online.", status.is_aircraft_online)
    if status.seat is not None:
        yield gauge("control", "1 while this ground controls.", status.seat is Seat.COMMAND)
    if status.round_trip_ms is not None:
        trip_s = status.round_trip_ms / 1000
        yield gauge("round_trip_seconds", "Round trip to the proxy.", trip_s)
    for name, text in _COUNTERS.items():
        yield counter(f"link_{name}", text, getattr(status, name))
    yield counter("frames", "Frames of telemetry that were shown.", telemetry.frames)
    yield counter("lost_frames", "Frames that did not arrive, or too late.", telemetry.lost)
