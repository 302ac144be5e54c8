"""Collects every module's telemetry, merges it and sends it (thesis 4.1.2, 4.1.5)."""

import math
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from up.base_module import BaseModule
from up.base_started_module import BaseStartedModule
from up.commands.beacon import fresh_s
from up.commands.panic_command import PanicCommand
from up.commands.refusal import Code, CommandRefusedError
from up.commands.system_commands import LinkStateCommand
from up.commands.telemetry_commands import TelemetryCommand, TelemetryFrequencyCommand
from up.log.limits import Limited, Once
from up.system.clock import Timer, cancel

DEFAULT_PERIOD_MS = 100.0
LOG_INTERVAL_S = 10.0
"""A ground that sets the period often must not fill the log."""
IDLE_POLL_S = 2.0
"""Polling period for a subscriber that starts to want telemetry without a new link."""
Conflict = Callable[[str, str, str], object]
MAX_DEPTH = 16
MAX_LENGTH = 1000
_INT_LIMIT = 2**63
_PLAIN = frozenset((bool, int, float, str, type(None)))
"""Types that are never a map: skips the slow isinstance check."""
_MAPS = (dict, Mapping)
"""In this order: a dict needs no slow check either."""


class TelemetryController(BaseStartedModule):
    """Publishes a TelemetryCommand every period; the ground sets the period, panic lengthens it.

    A module whose ``telemetry_content`` raises contributes nothing to that frame; a conflict drops
    the later module's key. Each is logged once and counted. Nothing is collected without a
    consumer: a subscriber may have a ``wants_telemetry`` that is false while it has no peers.
    """

    LOAD_ORDER = sys.maxsize

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
        return any(
            getattr(getattr(handler, "__self__", None), "wants_telemetry", True)
            for handler in self.up.command_executor.handlers_of(TelemetryCommand)
        )

    def collect(self) -> dict[str, Any]:
        return merge(self._contents(), self._on_conflict)

    def on_init(self) -> None:
        self.wanted_period_ms = DEFAULT_PERIOD_MS
        self.panic_delay_ms = 0
        self.frames = 0
        self.conflicts = 0
        self.faults = 0
        self._said = Once()
        self._timer: Timer | None = None
        self._sent_s = 0.0
        self._limited = Limited(self.context.reactor, LOG_INTERVAL_S)
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
        self._limited.stop()

    def _on_period(self, command: TelemetryFrequencyCommand) -> None:
        if command.period_ms < self.panic_delay_ms:
            raise CommandRefusedError(
                f"Raspberry Pi busy: telemetry at most every {self.panic_delay_ms} ms now; try"
                " again when its load is lower",
                Code.OVERLOADED,
            )
        self.wanted_period_ms = command.period_ms
        self._limited.log(
            self.log.info,
            "telemetry every {period_ms:.0f} ms",
            period_ms=command.period_ms,
            code="period_changed",
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
            if content is None or isinstance(content, _MAPS):
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


def merge(
    contents: Iterable[tuple[str, Mapping[str, Any]]], on_conflict: Conflict
) -> dict[str, Any]:
    """Merge (module name, content) pairs; maps are merged, everything else is a value.

    Two different values under one key are a conflict: calls ``on_conflict(key path, first module,
    later module)``, keeps the earlier value and drops only the later module's key. Numbers that are
    not finite become null. Values that JSON or a General Message cannot hold (other types, nesting
    beyond ``MAX_DEPTH``, text or lists beyond ``MAX_LENGTH``, integers of more than 64 bits, lone
    surrogates) are dropped as a conflict of the module with itself, and so is the rest of a map
    that raises while being read.
    """
    merged: dict[str, Any] = {}
    owners: dict[str | None, Any] = {}
    for module, content in contents:
        try:
            _merge_into(merged, content, module, (), owners, on_conflict)
        except Exception:  # noqa: BLE001 - a module's map must not cost the others' contents
            on_conflict("*", module, module)
    return merged


def _merge_into(
    target: dict[str, Any],
    content: Mapping[str, Any],
    module: str,
    path: tuple[str, ...],
    owners: dict[str | None, Any],
    on_conflict: Conflict,
) -> None:
    """Merge a map at ``path``; ``owners`` has the module of each value of ``target``.

    For a map it has the same of the map's values, and under None the module that gave it first.
    """
    is_too_deep = len(path) >= MAX_DEPTH
    for raw_key, raw in content.items():
        key = raw_key if isinstance(raw_key, str) else str(raw_key)
        if is_too_deep or not _is_sound(key):
            on_conflict(".".join(path), module, module)
            continue
        if type(raw) not in _PLAIN and isinstance(raw, _MAPS):
            if key not in target:
                target[key], owners[key] = {}, {None: module}
            elif not isinstance(target[key], dict):
                on_conflict(".".join((*path, key)), owners[key], module)
                continue
            _merge_into(target[key], raw, module, (*path, key), owners[key], on_conflict)
            continue
        try:
            value = _json_value(raw)
        except TypeError:
            on_conflict(".".join((*path, key)), module, module)
            continue
        if key not in target:
            target[key], owners[key] = value, module
        elif isinstance(target[key], dict):
            on_conflict(".".join((*path, key)), owners[key][None], module)
        elif target[key] != value:
            on_conflict(".".join((*path, key)), owners[key], module)


def _json_value(value: Any, depth: int = 0) -> Any:
    if value is None or value is True or value is False:
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, int) and -_INT_LIMIT <= value < _INT_LIMIT:
        return value
    if isinstance(value, str) and _is_sound(value):
        return value
    if isinstance(value, list | tuple) and len(value) <= MAX_LENGTH and depth < MAX_DEPTH:
        return [_json_value(each, depth + 1) for each in value]
    if isinstance(value, Mapping) and depth < MAX_DEPTH:
        return {str(key): _json_value(each, depth + 1) for key, each in value.items()}
    raise TypeError("no JSON, or too much of it")


def _is_sound(text: str) -> bool:
    if len(text) > MAX_LENGTH:
        return False
    try:
        return text.isascii() or bool(text.encode())
    except UnicodeEncodeError:
        return False
