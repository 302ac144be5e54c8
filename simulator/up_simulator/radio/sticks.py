"""The output of a radio: six pulses, or none."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Protocol

from up.errors import UserError
from up_simulator.aircraft.flight import FlightState
from up_simulator.firmware.board import Channel, FirmwareBoard

LOWEST_US, CENTRE_US, HIGHEST_US = 1000, 1500, 2000
SWITCH_US = {"ACRO": 1000, "FBW": 1500, "AUTO": 2000}
"""The mode switch (AUX1) position of each mode, in the default profile."""


CHANNELS: tuple[Channel, ...] = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")


class RadioError(UserError):
    """A radio cannot be used."""


@dataclass(frozen=True, slots=True)
class Sticks:
    """Pulses of the six channels, us; without ``is_on`` the receiver gets none of them."""

    ailerons: int = CENTRE_US
    elevator: int = CENTRE_US
    throttle: int = LOWEST_US
    rudder: int = CENTRE_US
    aux1: int = HIGHEST_US
    aux2: int = LOWEST_US
    is_on: bool = True

    @property
    def mode(self) -> str:
        return min(SWITCH_US, key=lambda mode: abs(SWITCH_US[mode] - self.aux1))

    @property
    def is_armed(self) -> bool:
        return self.aux2 > CENTRE_US

    def moved(self, channel: str, pulse_us: int) -> Sticks:
        moved: dict[str, Any] = {channel: pulse_us}
        return replace(self, **moved)


class Radio(Protocol):
    """A source of stick positions."""

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        """Return the positions at a monotonic time; ``state`` is visible to the pilot."""

    def close(self) -> None:
        """Release the terminal, the device or the socket."""


class Transmitter:
    """Sends sticks to a receiver; only changes are sent."""

    def __init__(self, receiver: FirmwareBoard) -> None:
        self._receiver = receiver
        self._sent: Sticks | None = None

    def send(self, sticks: Sticks) -> None:
        for channel in CHANNELS:
            pulse_us = getattr(sticks, channel)
            if self._sent is None or getattr(self._sent, channel) != pulse_us:
                self._receiver.set_stick(channel, pulse_us)
        # A receiver starts switched on: switching it on again would restart its frames.
        was_on = self._sent is None or self._sent.is_on
        if was_on != sticks.is_on:
            self._receiver.set_receiver(sticks.is_on)
        self._sent = sticks
