"""mission.yml: the limits of every mission."""

from collections.abc import Iterator

from up.config import ConfigFile, key
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class MissionConfig:
    """The mode MISSION: a mission outside these limits is refused as a whole."""

    max_distance_m: float = key(
        5000.0, "Greatest distance from home.", unit="m", minimum=100, maximum=50_000
    )
    max_height_m: float = key(
        120.0, "Greatest height above home.", unit="m", minimum=20, maximum=9000
    )
    min_height_m: float = key(
        20.0, "Least height above home, apart from the ground of a landing.", unit="m",
        minimum=-1000, maximum=1000,
    )  # fmt: skip

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.min_height_m >= self.max_height_m:
            yield "min_height_m", "must be below max_height_m"


MISSION_FILE = ConfigFile("mission.yml", MissionConfig)
