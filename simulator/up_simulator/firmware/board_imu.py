"""The IMU of a board as a flight sees it: its errors and its fault."""

from __future__ import annotations

from up_rig.imu import Motion
from up_simulator.firmware.board import ImuFault
from up_simulator.firmware.imu_errors import ImuErrors, ImuModel


class BoardImu:
    """State common to every board's IMU; ``motion`` holds until it is set again."""

    def __init__(self, errors: ImuErrors, seed: int) -> None:
        self._model = ImuModel(errors, seed)
        self._fault: ImuFault = "well"
        self.motion = Motion()

    @property
    def errors(self) -> ImuErrors:
        """Return its errors."""
        return self._model.errors

    @errors.setter
    def errors(self, errors: ImuErrors) -> None:
        self._model.errors = errors

    @property
    def throttle(self) -> float:
        """Return how fast the motor turns, 0 to 1."""
        return self._model.throttle

    @throttle.setter
    def throttle(self, throttle: float) -> None:
        self._model.throttle = throttle

    @property
    def fault(self) -> ImuFault:
        """Return the last fault set."""
        return self._fault

    def set_fault(self, fault: ImuFault) -> None:
        """Set a fault, or clear it."""
        self._fault = fault
