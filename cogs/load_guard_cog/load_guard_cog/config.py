"""load_guard.yml."""

from collections.abc import Iterator

from up.config import ConfigFile, key
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class LoadGuardConfig:
    """When Panic Mode begins and ends, and what it asks for."""

    panic_threshold: float = key(
        80.0,
        "Load at which Panic Mode begins.",
        name="panic threshold",
        unit="percent",
        minimum=1,
        maximum=100,
    )
    calm_down_threshold: float = key(
        65.0,
        "Load at which Panic Mode ends; below the panic threshold.",
        name="calm down threshold",
        unit="percent",
        minimum=0,
        maximum=99,
    )
    interval: float = key(
        1.0, "Time between two measurements of the load.", unit="s", minimum=0.1, maximum=10
    )
    dwell_s: float = key(
        5.0,
        "Minimum time between two switches.",
        name="dwell (s)",
        unit="s",
        minimum=5,
        maximum=600,
    )
    panic_delay_ms: int = key(
        150,
        "Minimum period of every sender to the Raspberry Pi in Panic Mode.",
        name="panic delay (ms)",
        unit="ms",
        minimum=10,
        maximum=1000,
    )
    normal_delay_ms: int = key(
        20,
        "Minimum period outside Panic Mode.",
        name="normal delay (ms)",
        unit="ms",
        minimum=10,
        maximum=1000,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.calm_down_threshold >= self.panic_threshold:
            yield "calm_down_threshold", "must be below the panic threshold"
        if self.normal_delay_ms >= self.panic_delay_ms:
            yield "normal_delay_ms", "must be below the panic delay"


LOAD_GUARD = ConfigFile("load_guard.yml", LoadGuardConfig)
