"""Chooses the flight mode that acts: the selected one, or one of its fallbacks."""

import math
from collections.abc import Callable, Iterable
from dataclasses import fields, is_dataclass
from functools import cache
from operator import attrgetter
from typing import Any, TypeVar

from twisted.logger import Logger

from up.commands.refusal import Code, CommandRefusedError
from up.fields import suggestion
from up.flight_modes.declarations import usable
from up.flight_modes.demand import AttitudeDemand, Circle, Demand, PathDemand, SurfacesDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation, ModeRefusal
from up.flight_modes.step_timer import StepTimer

FAILED, OVERRUN, INVALID, REFUSED, UNKNOWN = (
    "mode_failed",
    "mode_overrun",
    "demand_invalid",
    "mode_refused",
    "mode_unknown",
)
_T = TypeVar("_T")
_FAULTS = (Exception, SystemExit)
_DEMANDS = (PathDemand, AttitudeDemand, SurfacesDemand)
_NUMBERS = (int, float)


class DemandError(ValueError):
    """A Demand that cannot be carried out; ``code`` says why."""

    def __init__(self, text: str, code: str = INVALID) -> None:
        super().__init__(text)
        self.code = code


class FlightModeSelector:
    """Runs the selected mode; in the same step its fallback, if it may not or cannot act.

    A mode acts only while ``is_fresh(reading, max_age_s)`` holds for each of its ``NEEDS``; it
    acts again when they are fresh again. One that fails, overruns its time or demands what is
    invalid is not run again until it is selected again. ``problems`` are the modes that cannot be
    used as they are declared, and why.
    """

    log = Logger()

    def __init__(self, modes: Iterable[FlightMode], is_fresh: Callable[[str, float], bool]) -> None:
        self.modes, self.problems = usable(modes)
        self.selected: str | None = None
        self.active: str | None = None
        self.reason: str | None = None
        self._is_fresh = is_fresh
        self._candidates: tuple[str, ...] = ()
        self._broken: dict[str, str] = {}
        self._entered: set[str] = set()
        self.timer = StepTimer()
        self.running: str | None = None
        """The mode whose step or demand is being carried out."""

    def missing_for(self, name: str) -> list[str]:
        """Return the readings that keep a mode from acting."""
        needed = self.modes[name].NEEDS
        return [each for each, max_age_s in needed.items() if not self._is_fresh(each, max_age_s)]

    def _first_missing(self, name: str) -> str | None:
        for each, max_age_s in self.modes[name].NEEDS.items():
            if not self._is_fresh(each, max_age_s):
                return each
        return None

    def offers(self, situation: FlightSituation | None) -> dict[str, str | None]:
        """Return for each mode None if it can be entered now, else the reading or code why not."""
        return {
            name: self._why_not(mode, situation)
            for name, mode in self.modes.items()
            if mode.SELECTABLE
        }

    def _why_not(self, mode: FlightMode, situation: FlightSituation | None) -> str | None:
        missing = self.missing_for(mode.NAME)
        if missing or situation is None:
            return missing[0] if missing else "orientation"
        try:
            refusal = _refusal_of(mode, situation)
            return refusal.code if refusal else None
        except _FAULTS:
            return FAILED

    def check(self, name: str, situation: FlightSituation | None) -> None:
        """Raise CommandRefusedError, with the reason, if a mode cannot be entered now."""
        mode = self.modes.get(name)
        if mode is None or not mode.SELECTABLE:
            text = f"no flight mode {name}{suggestion(name, self.modes)}"
            raise CommandRefusedError(text, Code.INVALID, detail=UNKNOWN)
        missing = self.missing_for(name)
        if missing or situation is None:
            text = f"{name} needs {', '.join(missing or ['orientation'])}: missing or too old"
            raise CommandRefusedError(text, Code.UNAVAILABLE, detail="reading_stale")
        refusal = _refusal_of(mode, situation)
        if refusal:
            raise CommandRefusedError(f"{name}: {refusal.text}", detail=refusal.code)

    def select(self, name: str | None) -> None:
        """Select a mode, which is entered at its first step; None: none."""
        self.selected = name
        candidates: list[str] = []
        while name in self.modes and name not in candidates:
            candidates.append(name)
            name = self.modes[name].FALLBACK
        self._candidates = tuple(candidates)
        self.active = self.reason = None
        self._broken.clear()
        self._entered.clear()

    def step(
        self,
        situation: FlightSituation,
        dt_s: float,
        carry_out: Callable[[Demand, FlightSituation, float], _T],
    ) -> _T | None:
        """Return what ``carry_out`` made of the demand of the mode that acts; None: no mode can.

        ``carry_out`` raises DemandError for a demand that it cannot carry out.
        """
        reason: str | None = None
        for name in self._candidates:
            code = self._broken.get(name) or self._first_missing(name)
            if code is None:
                try:
                    made = self._run(self.modes[name], situation, dt_s, carry_out)
                except _FAULTS as error:
                    code = self._note_failure(name, error)
                else:
                    self._note_active(name, reason)
                    return made
            reason = reason or code
        self._note_active(None, reason)
        return None

    def _run(
        self,
        mode: FlightMode,
        situation: FlightSituation,
        dt_s: float,
        carry_out: Callable[[Demand, FlightSituation, float], _T],
    ) -> _T:
        timer = self.timer
        self.running = mode.NAME
        timer.start()
        if mode.NAME not in self._entered:
            self._entered.add(mode.NAME)
            mode.enter(situation)
        demand = mode.step(situation, dt_s)
        if timer.is_overrun(mode.TIME_BUDGET_S):
            raise DemandError(f"a step took {timer.last_s * 1000:.0f} ms", OVERRUN)
        if not isinstance(demand, _DEMANDS):
            raise DemandError(f"step returned {demand!r:.80}, not a Demand")
        if not _is_finite(demand):
            raise DemandError(f"{demand!r:.200} is not finite")
        path = demand.path if isinstance(demand, PathDemand) else None
        if isinstance(path, Circle) and path.radius_m <= 0:
            raise DemandError(f"the radius of a circle is {path.radius_m:g} m, not above 0")
        return carry_out(demand, situation, dt_s)

    def _note_failure(self, name: str, error: BaseException) -> str:
        if isinstance(error, DemandError):
            code, text = error.code, str(error)
        else:
            code, text = FAILED, f"{type(error).__name__}: {error}"
        # Readings come back by themselves, and so does the mode that needs them.
        if code in (FAILED, OVERRUN, INVALID):
            self._broken[name] = code
            self.log.error(
                "the flight mode {mode} is replaced by its fallback: {reason}",
                mode=name,
                reason=text,
                code=code,
            )
        return code

    def _note_active(self, name: str | None, reason: str | None) -> None:
        if name != self.active:
            self.log.info("flight mode {mode}", mode=name, code="mode_active", reason=reason)
        self.active, self.reason = name, reason


def _refusal_of(mode: FlightMode, situation: FlightSituation) -> ModeRefusal | None:
    refusal = mode.refusal(situation)
    if isinstance(refusal, str):
        return ModeRefusal(REFUSED, refusal) if refusal else None
    return refusal


def _is_finite(value: Any) -> bool:
    """Return whether a demand, or a part of one, has no other values than finite ones and None."""
    parts_of = _parts_of(value.__class__)
    if parts_of is None and not isinstance(value, tuple):
        return False
    for part in value if parts_of is None else parts_of(value):
        if part is None:
            continue
        if not (math.isfinite(part) if isinstance(part, _NUMBERS) else _is_finite(part)):
            return False
    return True


@cache
def _parts_of(kind: type) -> Callable[[Any], tuple[Any, ...]] | None:
    """Return what gives all fields of a dataclass; None for another class, or without fields."""
    names = [each.name for each in fields(kind)] if is_dataclass(kind) else []
    if len(names) == 1:
        return lambda value: (getattr(value, names[0]),)
    return attrgetter(*names) if names else None
