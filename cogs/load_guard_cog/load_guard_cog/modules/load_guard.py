"""Watches the load and switches Panic Mode (thesis 3.2.5)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from load_guard_cog.config import LOAD_GUARD
from load_guard_cog.meter import Meter, PsutilMeter
from load_guard_cog.panic_switch import PanicSwitch
from up.base_started_module import BaseStartedModule
from up.commands.panic_command import PanicCommand
from up.commands.system_commands import LinkStateCommand
from up.system.clock import Timer

MEMORY_EVERY_S = 5.0
"""Memory is only displayed, and measuring it costs more than measuring the load."""


class LoadGuard(BaseStartedModule):
    """Publishes a PanicCommand at every switch, and to a link that connects during panic."""

    CONFIG = LOAD_GUARD

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self.meter: Meter | None = None
        self.ram = 0.0
        self._timer: Timer | None = None
        self._memory_due_s = float("-inf")

    @property
    def in_panic(self) -> bool:
        """Return whether Panic Mode is on."""
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
        """Return the load, and whether it causes panic."""
        return {
            "load": {
                "cpu": self.cpu_utilization,
                "ram": self.ram,
                "panic": self.in_panic,
                "delay_ms": self.delay_ms,
            }
        }

    def on_init(self) -> None:
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
        if self._timer is not None and self._timer.active():
            self._timer.cancel()

    def _schedule(self) -> None:
        self._timer = self.context.reactor.callLater(self.config.interval, self._look)

    def _look(self) -> None:
        self._schedule()
        assert self.meter is not None
        now_s = self.context.reactor.seconds()
        if now_s >= self._memory_due_s:
            self._memory_due_s = now_s + MEMORY_EVERY_S
            self.ram = self.meter.memory_percent()
        if self._switch.update(self.meter.load_percent(), now_s):
            word = "busy" if self.in_panic else "not busy any more"
            self.log.info(
                "Raspberry Pi {word} ({cpu_utilization:.0f} %):"
                " every sender may send every {delay_ms} ms (Panic Mode)",
                word=word,
                cpu_utilization=self.cpu_utilization,
                delay_ms=self.delay_ms,
            )
            self._publish()

    def _on_link(self, command: LinkStateCommand) -> None:
        if command.connected and self.in_panic:
            self._publish()

    def _publish(self) -> None:
        self.up.command_executor.execute_command(
            PanicCommand(self.in_panic, self.delay_ms, self.cpu_utilization)
        )
