"""Which runner of a pool starts an instance."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable
from dataclasses import asdict
from typing import Any

from up.quick_dataclass import dataclass

HEARTBEAT_S = 1.0
FRESH_S = 3.0
"""A runner whose last heartbeat is older gets no instance."""


@dataclass(frozen=True, slots=True)
class RunnerInfo:
    """A runner as its last heartbeat shows it; `free`: instances that it can still start."""

    id: str
    host: str
    free: int
    labels: frozenset[str]

    def as_json(self) -> dict[str, Any]:
        return {**asdict(self), "labels": sorted(self.labels)}

    @classmethod
    def parse(cls, fields: dict[str, Any]) -> RunnerInfo:
        """Raises ValueError, KeyError or TypeError for fields of no runner."""
        labels = frozenset(map(str, fields["labels"]))
        return cls(str(fields["id"]), str(fields["host"]), int(fields["free"]), labels)


def ranking(aircraft: str, labels: Iterable[str], runners: Iterable[RunnerInfo]) -> list[str]:
    """Return the ids of the runners that may start an instance, the first choice first.

    Weighted rendezvous hashing: all runners compute the same order from the same heartbeats, and
    many aircraft spread in proportion to the free places.
    """
    needed = frozenset(labels)
    able = [each for each in runners if each.free > 0 and needed <= each.labels]

    def score(info: RunnerInfo) -> float:
        digest = hashlib.sha256(f"{info.id}/{aircraft}".encode()).digest()
        fraction = (int.from_bytes(digest[:7], "big") + 0.5) / 2**56
        return info.free / math.log(fraction)

    return [each.id for each in sorted(able, key=score)]
