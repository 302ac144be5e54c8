"""Watches the load and switches Panic Mode (thesis 3.2.5)."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any, Protocol

import psutil

from load_guard_cog.config import LOAD_GUARD
from up.base_started_module import BaseStartedModule
from up.commands.panic_command import PanicCommand
from up.commands.system_commands import LinkStateCommand
from up.system.clock import Timer, cancel

MEMORY_EVERY_S = 5.0
"""Memory is only displayed, and measuring it costs more than measuring the load."""


class LoadGuard(BaseStartedModule):
    """Publishes a PanicCommand at every switch, and to a link that connects during panic."""

    CONFIG = LOAD_GUARD

    meter: Meter | None = None

    @property
    def in_panic(self) -> bool:
        return self._switch.is_on

    @property
    def cpu_utilization(self) -> float:
        """Return the smoothed load, percent."""
        return round(self._switch.load_percent or 0.0, 1)

    @property
    def delay_ms(self) -> int:
        """Return the period that all senders must keep."""
        values = self.config
        delay: int = values.panic_delay_ms if self.in_panic else values.normal_delay_ms
        return delay

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        return {
            "load": {
                "cpu": self.cpu_utilization,
                "ram": self.ram,
                "panic": self.in_panic,
                "delay_ms": self.delay_ms,
            }
        }

    def on_init(self) -> None:
        self.ram = 0.0
        self._timer: Timer | None = None
        self._memory_due_s = float("-inf")
        values = self.config
        self._switch = PanicSwitch(
            values.panic_threshold, values.calm_down_threshold, values.dwell_s
        )
        self.up.command_executor.register_command(LinkStateCommand, self._on_link)

    def on_start(self) -> bool:
        if self.meter is None:
            self.meter = PsutilMeter()
        self._schedule()
        return True

    def on_stop(self) -> None:
        cancel(self._timer)

    def _schedule(self) -> None:
        self._timer = self.context.reactor.callLater(self.config.interval, self._poll)

    def _poll(self) -> None:
        self._schedule()
        assert self.meter is not None
        now_s = self.context.reactor.seconds()
        if now_s >= self._memory_due_s:
            self._memory_due_s = now_s + MEMORY_EVERY_S
            self.ram = self.meter.memory_percent()
        if self._switch.update(self.meter.load_percent(), now_s):
            word = "busy" if self.in_panic else "no longer busy"
            self.log.info(
                "Raspberry Pi {word} ({cpu_utilization:.0f} %):"
                " every sender may send every {delay_ms} ms (Panic Mode)",
                word=word,
                cpu_utilization=self.cpu_utilization,
                delay_ms=self.delay_ms,
                code="panic_changed",
            )
            self._publish()

    def _on_link(self, command: LinkStateCommand) -> None:
        if command.connected and self.in_panic:
            self._publish()

    def _publish(self) -> None:
        self.up.command_executor.execute_command(
            PanicCommand(self.in_panic, self.delay_ms, self.cpu_utilization)
        )


_MIN_INTERVAL_S = 1e-3


class Meter(Protocol):
    """Measures load."""

    def load_percent(self) -> float:
        """Return the load since the last call, 0 to 100."""

    def memory_percent(self) -> float:
        """Return the share of the memory in use, 0 to 100."""


class PsutilMeter:
    """Measures with psutil; the first load after construction covers the time since then."""

    def __init__(self) -> None:
        self._polled_s = self._used_s = 0.0
        self.load_percent()

    def load_percent(self) -> float:
        """Return the greater of the machine's load and this process's share of one core."""
        machine: float = psutil.cpu_percent(interval=None)
        now_s, used_s = time.monotonic(), time.process_time()
        passed_s = max(now_s - self._polled_s, _MIN_INTERVAL_S)
        own = 100.0 * (used_s - self._used_s) / passed_s
        self._polled_s, self._used_s = now_s, used_s
        return min(100.0, max(machine, own))

    def memory_percent(self) -> float:
        used: float = psutil.virtual_memory().percent
        return used


SMOOTHING_S = 2.0


class PanicSwitch:
    """Turns a noisy load (percent) into rare switches.

    The load is smoothed over ``SMOOTHING_S``; two switches are at least ``dwell_s`` apart.
    """

    def __init__(self, panic_percent: float, calm_percent: float, dwell_s: float) -> None:
        self.is_on = False
        self.load_percent: float | None = None
        self._panic_percent = panic_percent
        self._calm_percent = calm_percent
        self._dwell_s = dwell_s
        self._seen_at_s = 0.0
        self._switched_at_s = float("-inf")

    def update(self, load_percent: float, now_s: float) -> bool:
        """Take a measurement; return whether panic was switched, either way."""
        if self.load_percent is None:
            self.load_percent = load_percent
        else:
            part = min(1.0, (now_s - self._seen_at_s) / SMOOTHING_S)
            self.load_percent += (load_percent - self.load_percent) * part
        self._seen_at_s = now_s
        if now_s - self._switched_at_s < self._dwell_s:
            return False
        wanted = self.load_percent >= self._panic_percent
        if self.is_on:
            wanted = self.load_percent > self._calm_percent
        if wanted == self.is_on:
            return False
        self.is_on = wanted
        self._switched_at_s = now_s
        return True
