"""Relays data from an aircraft to all its grounds."""

from up_proxy.aircraft import Aircraft
from up_proxy.connection import Connection
from up_proxy.control import PREFIX, without_control
from up_proxy.poller import Poller


class AirSide:
    """Owns the airborne connection of one aircraft."""

    __slots__ = ("_aircraft", "_poller")

    def __init__(self, aircraft: Aircraft, poller: Poller) -> None:
        self._aircraft = aircraft
        self._poller = poller

    def seat(self, air: Connection) -> None:
        """Make a connection the aircraft's; the previous one is dropped."""
        aircraft = self._aircraft
        displaced = aircraft.air_seat.take(air, air.token or None)
        if displaced is not None:
            displaced.fail("another connection of this aircraft took its place")
        aircraft.announce(self._poller.now_s)

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Relay to every ground, without control lines: grounds trust those of the proxy."""
        aircraft = self._aircraft
        if aircraft.air_seat.occupant is not connection:
            return
        aircraft.air_bytes += len(lines)
        if PREFIX in lines:
            lines, control = without_control(lines)
            aircraft.dropped_lines += len(control)
            if not lines:
                return
        for ground in aircraft.grounds:
            dropped = ground.relay(lines)
            if dropped:
                aircraft.dropped_lines += dropped

    def on_half_line(self, connection: Connection) -> None:
        """Wait for the rest of the line."""

    def on_drained(self, connection: Connection) -> None:
        """Resume the grounds that filled the queue."""
        if self._aircraft.air_seat.occupant is connection:
            self._resume_grounds()

    def on_end(self, connection: Connection, reason: str) -> None:
        """Keep the aircraft's seat for its token."""
        aircraft = self._aircraft
        if aircraft.air_seat.occupant is connection:
            aircraft.air_seat.leave()
            self._resume_grounds()
            aircraft.announce(self._poller.tick())

    def _resume_grounds(self) -> None:
        for ground in self._aircraft.grounds:
            ground.resume()
