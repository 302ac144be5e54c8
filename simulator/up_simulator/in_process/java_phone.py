"""The Up Library as the phone aboard, in simulated time: a JVM that is moved step by step."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from up_simulator.aircraft.flight import Flight
from up_simulator.in_process.machine import Machine
from up_simulator.in_process.piped_sockets import PipedSockets
from up_simulator.phone.java_feed import SensorFeed
from up_simulator.phone.java_handset import JvmHandset, options_of
from up_simulator.phone.java_process import JavaPhoneProcess
from up_simulator.phone.java_program import JavaProgram

THINKS_S = 0.002
"""Simulated duration of the phone's work, during which the JVM runs beside the simulation."""
_TINY_S = 1e-6


class SteppedJavaHandset(JvmHandset):
    """A JVM in lock-step: it runs only when a timer, a reading or its network is due.

    Its sockets are opened on ``machine``, so that the same seed gives the same flight. The
    constructor starts the JVM, so that it is up when the firmware has booted.
    """

    def __init__(
        self,
        program: JavaProgram,
        machine: Machine,
        flight: Flight,
        place: Sequence[str],
        orientation: str,
        say: Callable[[str], None],
        *,
        seed: int = 1,
    ) -> None:
        super().__init__(SensorFeed(flight, seed=seed), machine, say)
        self._machine = machine
        self._sockets = PipedSockets(machine)
        self._due_s = math.inf
        self._is_asked = False
        options = [*options_of(orientation, seed), *place, "--stepped"]
        self._process = JavaPhoneProcess(program, *options)

    def start(self) -> None:
        """Start the phone's time."""
        self._due_s = self._machine.seconds()

    def tick(self) -> None:
        """Move the phone on until now, if anything is due."""
        process, now_s = self._process, self._machine.seconds()
        if process is None or self._is_asked:
            return
        is_due = min(self._due_s, self._feed.next_s) <= now_s + _TINY_S
        if not is_due and not self._sockets.is_urgent:
            return
        line: dict[str, Any] = {"t": round(now_s * 1000), **self._feed.readings(now_s)}
        if brought := self._sockets.take():
            line["net"] = brought
        self._is_asked = True
        process.ask(line)
        self._machine.callLater(THINKS_S, self._take_answer)

    async def stop(self) -> None:
        """End it, and close its sockets."""
        self._sockets.close()
        await super().stop()

    def _take_answer(self) -> None:
        process = self._process
        self._is_asked = False
        if process is None:
            return
        events, answer = process.answer()
        for event in events:
            self.take(event)
        if not answer:
            self.lose(process)
            return
        due_ms = answer["due"]
        self._due_s = math.inf if due_ms is None else due_ms / 1000
        for words in answer["net"]:
            self._sockets.do(words)

    def lose(self, process: JavaPhoneProcess) -> None:
        """Take that it has ended: its sockets go as by the system of a program that has died."""
        self._sockets.close()
        super().lose(process)
