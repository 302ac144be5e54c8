"""Packets in flight through one direction of a link."""

from __future__ import annotations

from collections import deque
from typing import Generic, TypeVar

from up_simulator.link.model import LinkModel

_T = TypeVar("_T")


class LinkPipe(Generic[_T]):
    """Holds packets until the model's arrival time; the order is kept.

    Several pipes may share a model, as connections share a cable.
    """

    def __init__(self, model: LinkModel, *, is_datagram: bool = False) -> None:
        self.model = model
        self._is_datagram = is_datagram
        self.waiting: deque[tuple[float, int, _T]] = deque()
        """Due time, the model's blackouts when it was sent, packet."""

    def send(self, packet: _T, size: int, now_s: float) -> None:
        due_s = self.model.send(size, now_s, is_datagram=self._is_datagram)
        if due_s is not None:
            self.waiting.append((due_s, self.model.blackouts, packet))

    def take(self, now_s: float) -> list[_T]:
        """Return the data that has arrived; data that met a blackout in flight is lost."""
        model, waiting = self.model, self.waiting
        while waiting and (model.is_black or waiting[0][1] != model.blackouts):
            waiting.popleft()
        arrived: list[_T] = []
        while waiting and model.arrival_s(waiting[0][0]) <= now_s:
            arrived.append(waiting.popleft()[2])
        return arrived
