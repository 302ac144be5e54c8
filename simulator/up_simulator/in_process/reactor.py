"""A reactor whose time only its owner moves, and the parts that all hosts on it share."""

from __future__ import annotations

import select
from bisect import bisect_right, insort
from collections.abc import Callable
from queue import Empty, SimpleQueue
from typing import Any

from twisted.internet.base import DelayedCall
from twisted.internet.main import CONNECTION_DONE, CONNECTION_LOST
from twisted.internet.task import Clock
from twisted.logger import Logger
from twisted.python.failure import Failure

from up_simulator.in_process.host import SimulatedHost
from up_simulator.in_process.network import Network
from up_simulator.link.model import LinkModel

STEP_S = 0.002
_STEP_NS = round(STEP_S * 1e9)
_TINY_S = 1e-9
_READABLE = select.POLLIN | select.POLLHUP | select.POLLERR | select.POLLNVAL


class SimulatedReactor(Clock):
    """The time, the network and the descriptors of all programs that fly in this process.

    Each program gets a ``host`` as its reactor. ``advance`` moves the time in steps of 2 ms:
    timers first, then descriptors, then arriving data, then departing data. Nothing happens
    between two calls, and the same calls give the same bytes everywhere, as long as no program
    uses threads. A call that raises is logged, as by any reactor.
    """

    log = Logger()
    calls: list[DelayedCall]

    def __init__(self) -> None:
        super().__init__()
        self.network = Network(self)
        self._now_ns = 0
        self._handed_over: SimpleQueue[Callable[[], Any]] = SimpleQueue()
        self._poll = select.poll()
        self._readers: dict[Any, int] = {}
        self._writers: dict[Any, int] = {}

    def host(self) -> SimulatedHost:
        """Return a reactor for one program."""
        return SimulatedHost(self)

    def link(self, port: int, up: LinkModel, down: LinkModel) -> None:
        """Route connections and datagrams to a port over a link from now on.

        ``up`` is the direction to the port, ``down`` the one back. Ports may share the models.
        """
        self.network.link(port, up, down)

    def callLater(  # type: ignore[override]  # noqa: N802 - Twisted's name
        self, when: float, what: Callable[..., object], *a: object, **kw: object
    ) -> DelayedCall:
        """Call ``what`` at its time; of equal times the earlier call is first."""
        call = DelayedCall(
            self.rightNow + when, what, a, kw, self._discard, self._sort, self.seconds
        )
        self.put_back(call)
        return call

    def put_back(self, call: DelayedCall) -> None:
        insort(self.calls, call, key=DelayedCall.getTime)

    def call_from_thread(self, call: Callable[[], Any]) -> None:
        self._handed_over.put(call)

    def advance(self, amount: float) -> None:
        """Move the time on, in whole steps and a rest."""
        left_ns = round(amount * 1e9)
        while left_ns > 0:
            step_ns = min(_STEP_NS, left_ns)
            left_ns -= step_ns
            self._step(step_ns)

    def add_reader(self, reader: Any) -> None:
        """Call ``reader.doRead`` when its descriptor has something to read."""
        self._readers[reader] = reader.fileno()
        self._watch(self._readers[reader])

    def remove_reader(self, reader: Any) -> None:
        """Stop watching a reader; an unknown one is ignored."""
        number = self._readers.pop(reader, None)
        if number is not None:
            self._watch(number)

    def add_writer(self, writer: Any) -> None:
        """Call ``writer.doWrite`` when its descriptor takes bytes."""
        self._writers[writer] = writer.fileno()
        self._watch(self._writers[writer])

    def remove_writer(self, writer: Any) -> None:
        """Stop watching a writer; an unknown one is ignored."""
        number = self._writers.pop(writer, None)
        if number is not None:
            self._watch(number)

    def guarded(self, call: Callable[..., Any], *arguments: Any, **more: Any) -> Any:
        """Call foreign code; an exception is logged and ends nothing."""
        try:
            return call(*arguments, **more)
        except Exception:  # noqa: BLE001 - a reactor outlives the faults of what it calls
            self.log.failure("an unhandled error in {call}", call=call)
            return None

    def _step(self, step_ns: int) -> None:
        # Counted in whole numbers: a sum of many small steps would drift.
        self._now_ns += step_ns
        self.rightNow = now_s = self._now_ns / 1e9
        if not self._handed_over.empty():
            self._run_handed_over()
        if self.calls and self.calls[0].getTime() <= now_s + _TINY_S:
            self._make_calls(now_s + _TINY_S)
        if self._readers or self._writers:
            self._serve_descriptors()
        self.network.move(now_s)

    def _make_calls(self, due_s: float) -> None:
        """Make the calls that are due; calls scheduled by them wait for the next step."""
        count = bisect_right(self.calls, due_s, key=DelayedCall.getTime)
        due, self.calls[:count] = self.calls[:count], []
        for call in due:
            if not call.active():
                continue
            if call.getTime() > due_s:
                self.put_back(call)
                continue
            call.called = 1
            self.guarded(call.func, *call.args, **call.kw)

    def _discard(self, call: DelayedCall) -> None:
        if call in self.calls:
            self.calls.remove(call)

    def _sort(self, call: DelayedCall) -> None:
        self.calls.sort(key=DelayedCall.getTime)

    def _run_handed_over(self) -> None:
        for _ in range(self._handed_over.qsize()):
            try:
                call = self._handed_over.get_nowait()
            except Empty:
                return
            self.guarded(call)

    def _watch(self, number: int) -> None:
        events = select.POLLIN if number in self._readers.values() else 0
        events |= select.POLLOUT if number in self._writers.values() else 0
        if events:
            self._poll.register(number, events)
        else:
            self._poll.unregister(number)

    def _serve_descriptors(self) -> None:
        for number, events in self._poll.poll(0):
            if events & _READABLE:
                for reader in [each for each, of in self._readers.items() if of == number]:
                    self._serve(reader, reader.doRead)
            if events & select.POLLOUT:
                for writer in [each for each, of in self._writers.items() if of == number]:
                    self._serve(writer, writer.doWrite)

    def _serve(self, selectable: Any, work: Callable[[], Any]) -> None:
        try:
            why = work()
        except Exception as error:  # noqa: BLE001 - as of any reactor: it loses its descriptor
            self.log.failure("an unhandled error in {work}", work=work)
            why = error
        if why:
            self.remove_reader(selectable)
            self.remove_writer(selectable)
            is_usual = why in (CONNECTION_DONE, CONNECTION_LOST)
            reason = Failure(why if is_usual or isinstance(why, BaseException) else CONNECTION_LOST)
            self.guarded(selectable.connectionLost, reason)
