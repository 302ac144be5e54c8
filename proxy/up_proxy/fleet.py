"""All aircraft with connections, by name."""

from dataclasses import dataclass

from up_proxy.air_side import AirSide
from up_proxy.aircraft import Aircraft
from up_proxy.ground_side import GroundSide
from up_proxy.hello import FULL, HelloError
from up_proxy.journal import Journal
from up_proxy.poller import Poller


@dataclass(frozen=True, slots=True)
class Party:
    """One aircraft and the owners of its connections."""

    aircraft: Aircraft
    air: AirSide
    ground: GroundSide


@dataclass(slots=True)
class Totals:
    """Counters since the start, including aircraft that are gone."""

    air_bytes: int = 0
    ground_bytes: int = 0
    dropped_lines: int = 0
    unheard_lines: int = 0

    def add(self, aircraft: Aircraft) -> None:
        """Add the counters of one aircraft."""
        self.air_bytes += aircraft.air_bytes
        self.ground_bytes += aircraft.ground_bytes
        self.dropped_lines += aircraft.dropped_lines
        self.unheard_lines += aircraft.unheard_lines


class Fleet:
    """Creates an aircraft when its first connection names it, removes it after its last one."""

    def __init__(
        self, poller: Poller, journal: Journal, aircraft_max: int, listeners_max: int
    ) -> None:
        self._poller = poller
        self._journal = journal
        self._aircraft_max = aircraft_max
        self._listeners_max = listeners_max
        self._parties: dict[str, Party] = {}
        self._gone = Totals()

    def __len__(self) -> int:
        return len(self._parties)

    def aircraft(self) -> list[Aircraft]:
        """Return every known aircraft."""
        return [party.aircraft for party in self._parties.values()]

    def totals(self) -> Totals:
        """Return the sums over all aircraft since the start."""
        gone = self._gone
        totals = Totals(gone.air_bytes, gone.ground_bytes, gone.dropped_lines, gone.unheard_lines)
        for aircraft in self.aircraft():
            totals.add(aircraft)
        return totals

    def party(self, name: str) -> Party:
        """Return the aircraft of this name, creating it if it is unknown.

        Raises HelloError with code `full` if there are too many.
        """
        party = self._parties.get(name)
        if party is None:
            if len(self._parties) >= self._aircraft_max:
                raise HelloError(FULL, "the proxy serves as many aircraft as it may")
            aircraft = Aircraft(name, self._journal)
            party = self._parties[name] = Party(
                aircraft, AirSide(aircraft, self._poller), GroundSide(aircraft, self._poller)
            )
        return party

    def check_room(self, aircraft: Aircraft, now_s: float, token: str | None = None) -> None:
        """Raise HelloError with code `full` if no further ground may listen.

        A ground that takes a free seat, or resumes one with its token, is always accepted.
        """
        seat = aircraft.command_seat
        listeners = len(aircraft.grounds) - (seat.occupant is not None)
        if listeners >= self._listeners_max and not (
            seat.is_free(now_s) or seat.is_resumed_by(token)
        ):
            raise HelloError(FULL, "this aircraft has as many grounds as it may")

    def sweep(self, now_s: float) -> None:
        """Detect silent peers, and remove aircraft without connections."""
        for name, party in list(self._parties.items()):
            aircraft = party.aircraft
            holder = aircraft.command_seat.occupant
            if holder is not None and holder.paused_s is not None:
                party.ground.keep_paused_alive(holder, now_s)
            aircraft.announce(now_s)
            if aircraft.is_deserted(now_s):
                self._gone.add(aircraft)
                del self._parties[name]
