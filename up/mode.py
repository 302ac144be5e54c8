"""The operation modes (thesis 2.4.7)."""

from enum import Enum


class Mode(Enum):
    """The mode of the system; ``AUTO`` is Flight Controller Mode until no board answers."""

    AUTO = "auto"
    FLIGHT_CONTROLLER = "flight controller"
    BLACK_BOX = "black box"

    @property
    def may_control(self) -> bool:
        """Return whether a board is expected and the aircraft can be controlled."""
        return self is not Mode.BLACK_BOX


IN_EVERY_MODE = frozenset(Mode)
WITH_BOARD = frozenset({Mode.AUTO, Mode.FLIGHT_CONTROLLER})
WITH_ARDUINO = WITH_BOARD
"""Deprecated name of WITH_BOARD."""
