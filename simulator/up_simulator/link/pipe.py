"""Packets in flight through one direction of a link."""

from __future__ import annotations

import math
from collections import deque
from typing import Generic, TypeVar

from up_simulator.link.model import LinkModel

_T = TypeVar("_T")


class LinkPipe(Generic[_T]):
    """Holds packets until the model's arrival time; the order is kept.

    Several pipes may share a model, as connections share a cable. ``lost`` counts lost packets.
    """

    def __init__(self, model: LinkModel, *, is_datagram: bool = False) -> None:
        self.model = model
        self.lost = 0
        self._is_datagram = is_datagram
        self.waiting: deque[tuple[float, int, _T]] = deque()
        """Due time, the model's blackouts when it was sent, packet."""

    def __len__(self) -> int:
        return len(self.waiting)

    def send(self, packet: _T, size: int, now_s: float) -> bool:
        """Take a packet of that many bytes; False: it vanished."""
        model = self.model
        due_s = model.send(size, now_s, is_datagram=self._is_datagram)
        if due_s is None:
            self.lost += 1
            return False
        self.waiting.append((due_s, model.blackouts, packet))
        return True

    def next_s(self) -> float:
        """Return when the next packet arrives: infinity while none will."""
        return self.model.arrival_s(self.waiting[0][0]) if self.waiting else math.inf

    def take(self, now_s: float) -> list[_T]:
        """Return the data that has arrived; data that met a blackout in flight is lost."""
        model, waiting = self.model, self.waiting
        while waiting and (model.is_black or waiting[0][1] != model.blackouts):
            waiting.popleft()
            self.lost += 1
        arrived: list[_T] = []
        while waiting and model.arrival_s(waiting[0][0]) <= now_s:
            arrived.append(waiting.popleft()[2])
        return arrived

    def clear(self) -> None:
        self.waiting.clear()
