"""The course and the altitude that the ground requires of the active flight mode."""

from __future__ import annotations

from collections.abc import Mapping

from raspilot.flight_modes.guided import altitude_refusal
from up.commands.refusal import CommandRefusedError
from up.flight_modes.flight_mode import FlightMode, FlightSituation
from up.flight_modes.selector import REFUSED


class GroundRequests(dict[str, float]):
    """What the ground requires, by ``course`` (deg) and ``altitude`` (m above sea level)."""

    def require(
        self,
        what: str,
        value: float,
        acting: str | None,
        modes: Mapping[str, FlightMode],
        situation: FlightSituation | None,
        max_climb_m: float,
    ) -> None:
        """Keep a value; raises CommandRefusedError unless the acting mode can follow it."""
        if acting is None or acting not in modes or what not in modes[acting].REQUESTS:
            able = [name for name, each in modes.items() if what in each.REQUESTS]
            raise CommandRefusedError(
                f"a required {what} acts in {' and '.join(able) or 'no flight mode'} only",
                detail=REFUSED,
            )
        state = None if situation is None else situation.navigation
        if what == "altitude" and situation is not None and state is not None:
            refusal = altitude_refusal(value, state, situation.home, max_climb_m)
            if refusal is not None:
                raise CommandRefusedError(refusal.text, detail=refusal.code)
        self[what] = value
