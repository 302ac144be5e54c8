"""The base of the providers that Commands update."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Generic, TypeVar

from up.base_started_module import BaseStartedModule
from up.commands.command import BaseCommand
from up.commands.refusal import NO_NAVIGATION, Code, CommandRefusedError
from up.commands.system_commands import SourceSelectedCommand
from up.config.application import PROVIDERS
from up.providers.source_arbiter import SourceArbiter
from up.providers.subscription import Subscription
from up.quick_dataclass import dataclass
from up.quick_init import quick_init

_T = TypeVar("_T")


class BaseProvider(BaseStartedModule, Generic[_T]):
    """Keeps the newest reading of one kind from the followed source.

    Subclasses name the ``READING`` (its key in ``age_ms`` and ``source`` of telemetry), the
    ``COMMAND`` that updates it and ``MAX_AGE_S``, after which a source is stale; they
    convert the Command to the value in ``_value_of`` and receive changes in ``_on_changed``.
    """

    CONFIG = PROVIDERS
    READING: ClassVar[str] = ""
    COMMAND: ClassVar[type[BaseCommand]] = BaseCommand
    MAX_AGE_S: ClassVar[float] = 1.0

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self._reading: Reading[_T] | None = None
        self._arbiter = SourceArbiter(self.MAX_AGE_S, self._on_switch)
        self._priorities: Mapping[str, int] = {}
        self.is_doubted: Callable[[str], bool] | None = None
        """Whether the data of a source are left out now, so that another one is followed."""

    def on_init(self) -> None:
        wanted = self.config.order_of(self.READING)
        self._priorities = {name: 1000 - place for place, name in enumerate(wanted)}
        self._seconds = self.context.reactor.seconds
        self.up.command_executor.register_command(self.COMMAND, self._on_command)

    @property
    def reading(self) -> Reading[_T] | None:
        """Return the newest reading of the followed source, however old; None before the first.

        A subclass that computes it on demand overrides ``fresh`` too.
        """
        return self._reading

    def fresh(self, max_age_s: float) -> Reading[_T] | None:
        """Return the newest reading when it is valid and at most ``max_age_s`` old."""
        reading = self._reading
        if reading is None or not reading.valid or self._seconds() - reading.time_s > max_age_s:
            return None
        return reading

    def subscribe(
        self,
        on_changed: Callable[[Reading[_T]], Any],
        on_stale: Callable[[], object] | None = None,
        max_age_s: float | None = None,
    ) -> None:
        """Call ``on_changed`` with each new valid reading of the followed source.

        ``on_stale`` is called once when the newest becomes invalid or older than ``max_age_s``
        (default: MAX_AGE_S), and again after further readings. The calls end with the module that
        subscribes in its ``on_init`` or ``on_start``.
        """
        Subscription(self, on_changed, on_stale, max_age_s or self.MAX_AGE_S)

    @property
    def value(self) -> _T | None:
        """Return the newest value, whatever its age: for display, never for control."""
        reading = self.reading
        return None if reading is None else reading.value

    @property
    def age_ms(self) -> int | None:
        reading = self.reading
        return None if reading is None else round(reading.age_s(self._seconds()) * 1000)

    def _value_of(self, command: Any) -> _T | None:
        """Return the value in a Command, by default itself; None if not for this reading."""
        value: _T = command
        return value

    def _is_valid(self, command: Any) -> bool:
        """Return whether the source marks the value as valid."""
        return True

    def _on_changed(self, reading: Reading[_T]) -> None:
        """Called for a new reading."""

    def _on_command(self, command: Any) -> None:
        value = self._value_of(command)
        if value is None:
            return
        now_s = self._seconds()
        origin = self.up.command_executor.origin
        if self.is_doubted is not None and self.is_doubted(origin.link):
            self._arbiter.note_left_out(origin.link, now_s)
            return
        valid = self._is_valid(command)
        if valid:
            priority = self._priorities.get(origin.link, origin.priority)
            if not self._arbiter.accepts(origin.link, priority, now_s):
                return
        else:
            self._arbiter.note_invalid(origin.link, now_s)
            if self._arbiter.current not in ("", origin.link):
                return
        self._reading = Reading(value, origin.link, now_s, valid)
        self._on_changed(self._reading)

    def _on_switch(self, previous: str, source: str) -> None:
        self.up.command_executor.execute_command(SourceSelectedCommand(self.READING, source))
        if previous:
            self.log.warn(
                "{reading} now comes from {source}, no longer from {previous}",
                reading=self.READING,
                source=source,
                previous=previous,
                code="source_switched",
            )
        else:
            self.log.info(
                "{reading} comes from {source}",
                reading=self.READING,
                source=source,
                code="source_selected",
            )

    def _ages(self) -> dict[str, Any]:
        """Return the part of telemetry common to all readings."""
        reading = self.reading
        source = None if reading is None else reading.source
        return {"age_ms": {self.READING: self.age_ms}, "source": {self.READING: source}}


def require(flight_control: Any, what: str, value: float) -> None:
    """Request a ``course`` or ``altitude`` of the flight controller, or of none.

    Raises CommandRefusedError when nothing follows it.
    """
    if flight_control is None:
        raise CommandRefusedError(NO_NAVIGATION, Code.NOT_SUPPORTED)
    flight_control.require(what, value)


@quick_init
@dataclass(frozen=True, slots=True)
class Reading(Generic[_T]):
    """A value, its source, its monotonic time in seconds and whether the source marks it valid."""

    value: _T
    source: str
    time_s: float
    valid: bool = True

    def age_s(self, now_s: float) -> float:
        return now_s - self.time_s
