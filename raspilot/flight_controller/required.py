"""The course and the altitude that the ground requires of the active flight mode."""

from collections.abc import Mapping

from raspilot.flight_modes.guided import altitude_refusal
from up.commands.refusal import CommandRefusedError
from up.flight_modes.flight_mode import FlightMode, FlightSituation
from up.flight_modes.selector import REFUSED


def check_required(
    what: str,
    value: float,
    acting: str | None,
    modes: Mapping[str, FlightMode],
    situation: FlightSituation | None,
    max_climb_m: float,
) -> None:
    """Raise CommandRefusedError unless the acting mode can follow a requirement of the ground.

    ``what`` is ``course`` (``value`` in deg) or ``altitude`` (m above sea level).
    """
    if acting is None or acting not in modes or what not in modes[acting].REQUESTS:
        able = [name for name, each in modes.items() if what in each.REQUESTS]
        raise CommandRefusedError(
            f"a required {what} acts in {' and '.join(able) or 'no flight mode'} only",
            detail=REFUSED,
        )
    if what != "altitude" or situation is None or situation.navigation is None:
        return
    refusal = altitude_refusal(value, situation.navigation, situation.home, max_climb_m)
    if refusal is not None:
        raise CommandRefusedError(refusal.text, detail=refusal.code)
