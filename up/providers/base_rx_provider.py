"""The inputs of the pilot's receiver."""

from collections.abc import Mapping
from typing import Any

from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.telemetry_schema import READINGS
from up.providers.base_provider import BaseProvider

CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")


class BaseRXProvider(BaseProvider[RXCommand]):
    """Provides the receiver's inputs, us of pulse; valid while every channel is."""

    READING = "rx"
    COMMAND = RXCommand
    MAX_AGE_S = READINGS[READING].source_s

    def get_channels(self) -> dict[str, int] | None:
        """Return the newest inputs by channel, us; None before the first."""
        newest = self.value
        if newest is None:
            return None
        return {name: getattr(newest, f"{name}_us") for name in CHANNELS}

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        channels = self.get_channels()
        return self._ages() if channels is None else {"rx": channels, **self._ages()}

    def _is_valid(self, command: Any) -> bool:
        return bool(command.valid == ALL_VALID)


class UpRXProvider(BaseRXProvider):
    """The receiver's inputs, from any link."""
