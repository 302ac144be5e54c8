"""discovery.yml."""

from up.config import ConfigFile, key
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class DiscoveryConfig:
    """How the airborne phone finds the Raspberry Pi, whose address changes."""

    port: int = key(
        3001,
        "UDP port of requests, usually by broadcast. 0: any free port, which is logged.",
        minimum=0,
        maximum=65535,
    )


DISCOVERY = ConfigFile("discovery.yml", DiscoveryConfig)
