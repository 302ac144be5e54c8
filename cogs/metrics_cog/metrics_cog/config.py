"""metrics.yml."""

from collections.abc import Iterator

from up.config import ConfigFile, key
from up.quick_dataclass import dataclass
from up.system.figures import PACKAGE_MISSING, is_installed


@dataclass(frozen=True, slots=True)
class MetricsConfig:
    """The page for Prometheus, which only programs of this machine can read."""

    port: int | None = key(
        None,
        "TCP port on 127.0.0.1, usually 9304. Empty: no page. 0: any free port, which is logged.",
        minimum=0,
        maximum=65535,
    )

    def problems(self) -> Iterator[tuple[str, str, str]]:
        if self.port is not None and not is_installed():
            yield "port", *PACKAGE_MISSING


METRICS = ConfigFile("metrics.yml", MetricsConfig)
