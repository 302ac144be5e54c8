"""The figures of a program as text for Prometheus, by the package prometheus-client."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from importlib.util import find_spec
from types import SimpleNamespace
from typing import Any, Literal

from up.quick_dataclass import dataclass

PACKAGE_MISSING = (
    "needs the Python package prometheus-client: pip install 'raspilot[metrics]'",
    "package_missing",
)
"""A sentence and its code."""


@dataclass(frozen=True, slots=True)
class Figure:
    """One value; figures of one name have the same labels and the same ``help``."""

    name: str
    help: str
    value: float
    labels: Mapping[str, str] = field(default_factory=dict)
    kind: Literal["gauge", "counter", "unknown"] = "gauge"


def is_installed() -> bool:
    """Return whether the package is installed; nothing is imported."""
    return find_spec("prometheus_client") is not None


def text_of(figures: Iterable[Figure]) -> str:
    """Return the page of the figures."""
    from prometheus_client import core, generate_latest

    makers = {
        "gauge": core.GaugeMetricFamily,
        "counter": core.CounterMetricFamily,
        "unknown": core.UnknownMetricFamily,
    }
    families: dict[str, Any] = {}
    for each in figures:
        if each.name not in families:
            make: Any = makers[each.kind]
            families[each.name] = make(each.name, each.help, labels=tuple(each.labels))
        families[each.name].add_metric(tuple(each.labels.values()), each.value)
    source: Any = SimpleNamespace(collect=families.values)
    return generate_latest(source).decode("utf-8")


def numbers(tree: Mapping[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[str, float]]:
    """Yield the finite numbers and the flags of nested maps by their keys, joined by dots."""
    for key, value in tree.items():
        if isinstance(value, Mapping):
            yield from numbers(value, (*path, str(key)))
        elif isinstance(value, int | float) and math.isfinite(value):
            yield ".".join((*path, str(key))), float(value)
