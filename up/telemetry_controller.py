"""Collects every module's telemetry, merges it and sends it (thesis 4.1.2, 4.1.5)."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from up.base_module import BaseModule
from up.base_started_module import BaseStartedModule
from up.commands.beacon import fresh_s
from up.commands.panic_command import PanicCommand
from up.commands.refusal import Code, CommandRefusedError
from up.commands.system_commands import LinkStateCommand
from up.commands.telemetry_commands import TelemetryCommand, TelemetryFrequencyCommand
from up.log.limits import Once
from up.merge import merge
from up.system.clock import Timer, cancel

DEFAULT_PERIOD_MS = 100.0
IDLE_POLL_S = 2.0
"""Polling period for a subscriber that starts to want telemetry without a new link."""


class TelemetryController(BaseStartedModule):
    """Publishes a TelemetryCommand every period; the ground sets the period, panic lengthens it.

    A module whose ``telemetry_content`` raises contributes nothing to that frame; a conflict drops
    the later module's key. Each is logged once and counted. Nothing is collected without a
    consumer: a subscriber may have a ``wants_telemetry`` that is false while it has no peers.
    """

    LOAD_ORDER: ClassVar[int] = sys.maxsize

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self.wanted_period_ms = DEFAULT_PERIOD_MS
        self.panic_delay_ms = 0
        self.frames = 0
        self.conflicts = 0
        self.faults = 0
        self._said = Once()
        self._timer: Timer | None = None
        self._sent_s = 0.0

    @property
    def period_ms(self) -> float:
        return max(self.wanted_period_ms, float(self.panic_delay_ms))

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        counters = {"frames": self.frames, "conflicts": self.conflicts, "faults": self.faults}
        return {
            "counters": {"telemetry": counters},
            "system": {"period_ms": round(self.period_ms)},
        }

    @property
    def is_wanted(self) -> bool:
        """Return whether a subscriber of telemetry wants it."""
        return any(
            getattr(getattr(handler, "__self__", None), "wants_telemetry", True)
            for handler in self.up.command_executor.handlers_of(TelemetryCommand)
        )

    def collect(self) -> dict[str, Any]:
        return merge(self._contents(), self._on_conflict)

    def on_init(self) -> None:
        executor = self.up.command_executor
        executor.register_command(TelemetryFrequencyCommand, self._on_period)
        executor.register_command(PanicCommand, self._on_panic)
        executor.register_command(LinkStateCommand, self._on_link)

    def on_start(self) -> bool:
        self._sent_s = self.context.reactor.seconds()
        self._schedule()
        return True

    def on_stop(self) -> None:
        cancel(self._timer)

    def _on_period(self, command: TelemetryFrequencyCommand) -> None:
        if command.period_ms < self.panic_delay_ms:
            raise CommandRefusedError(
                f"Raspberry Pi busy: telemetry at most every {self.panic_delay_ms} ms now; try"
                " again when its load is lower",
                Code.OVERLOADED,
            )
        self.wanted_period_ms = command.period_ms
        self.log.info(
            "telemetry every {period_ms:.0f} ms", period_ms=command.period_ms, code="period_changed"
        )
        self._reschedule()

    def _on_panic(self, command: PanicCommand) -> None:
        self.panic_delay_ms = command.delay_ms if command.panic else 0
        self._reschedule()

    def _on_link(self, command: LinkStateCommand) -> None:
        if command.connected:
            self._reschedule()

    def _reschedule(self) -> None:
        if self._timer is None or not self._timer.active():
            return
        # A longer period begins after the frame that reports it to the ground.
        if self._sent_s + self.period_ms / 1000 < self._due_s:
            self._timer.cancel()
            self._schedule()

    def _schedule(self) -> None:
        # Counted from the previous frame: repeated changes of the period cause no delay.
        now_s = self.context.reactor.seconds()
        self._due_s = max(self._sent_s + self.period_ms / 1000, now_s)
        self._timer = self.context.reactor.callLater(self._due_s - now_s, self._transmit)

    def _transmit(self) -> None:
        # The first frame is always collected, so that failing telemetry is reported immediately.
        if self.frames and not self.is_wanted:
            self._timer = self.context.reactor.callLater(IDLE_POLL_S, self._transmit)
            self._due_s = self.context.reactor.seconds() + IDLE_POLL_S
            return
        self._sent_s = self._due_s
        self._schedule()
        self.frames += 1
        content = self.collect()
        self.up.beacons.limit_s = fresh_s(self.period_ms)
        self.up.command_executor.execute_command(TelemetryCommand(content, self.up.beacons.draw()))

    def _contents(self) -> Iterator[tuple[str, Mapping[str, Any]]]:
        yield "Up", self.up.telemetry_content
        for module in self.up.modules:
            content = self._content_of(module)
            if content:
                yield module.class_name, content

    def _content_of(self, module: BaseModule) -> Mapping[str, Any] | None:
        try:
            content = module.telemetry_content
            if content is None or isinstance(content, Mapping):
                return content
            raise TypeError(f"telemetry_content is {type(content).__name__}, no map")
        except (Exception, SystemExit):  # noqa: BLE001 - a fault costs one module's part only
            self.faults += 1
            if self._said.first(module.path):
                self.log.failure(
                    "the telemetry of {name} failed",
                    name=module.class_name,
                    code="telemetry_failed",
                )
            return None

    def _on_conflict(self, key: str, first: str, later: str) -> None:
        self.conflicts += 1
        if not self._said.first((key, first, later)):
            return
        if first == later:
            self.log.error(
                "{later} gives telemetry {key} a value that JSON does not have",
                later=later,
                key=key,
                code="telemetry_not_json",
            )
        else:
            self.log.error(
                "telemetry {key}: {first} and {later} give it different values; the one of"
                " {later} is dropped",
                key=key,
                first=first,
                later=later,
                code="telemetry_conflict",
            )
