"""providers.yml: which sources the providers prefer."""

from __future__ import annotations

from dataclasses import dataclass

from up.config.file import ConfigFile
from up.config.schema import items
from up.fields import Constraint

_SOURCE = Constraint(str, max_length=64)


def _order(reading: str) -> tuple[str, ...]:
    made: tuple[str, ...] = items(
        _SOURCE,
        f"Sources of the {reading}, the preferred first. Empty: as the links say (the Arduino "
        "before the phone).",
        max_length=16,
    )
    return made


@dataclass(frozen=True, slots=True)
class ProvidersConfig:
    """Which sources the providers prefer, by the names of their links (arduino, android, ...)."""

    orientation: tuple[str, ...] = _order("orientation")
    location: tuple[str, ...] = _order("location")
    altitude: tuple[str, ...] = _order("altitude")
    heading: tuple[str, ...] = _order("heading")
    rx: tuple[str, ...] = _order("receiver inputs")

    def order_of(self, reading: str) -> tuple[str, ...]:
        """Return the preferred sources of a reading; empty for a reading without a key."""
        order: tuple[str, ...] = getattr(self, reading, ())
        return order


PROVIDERS = ConfigFile("providers.yml", ProvidersConfig)
