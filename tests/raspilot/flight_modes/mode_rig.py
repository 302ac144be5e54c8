"""A flight mode that flies a point mass through the path controller."""

from twisted.internet.task import Clock

from tests.raspilot.navigation.point_mass import STEP_S, PointMass
from up.commands.orientation_command import OrientationCommand
from up.commands.rx_command import ALL_VALID, RXCommand
from up.context import Context
from up.flight_modes.demand import PathDemand
from up.flight_modes.flight_mode import FlightSituation
from up.mode import Mode


def bound(mode, folder, **files):
    """Return a mode of this class, with configuration files as texts."""
    for name, text in files.items():
        (folder / f"{name}.yml").write_text(text)
    made = mode()
    made.bind(Context(Clock(), Mode.AUTO, folder))
    return made


def sticks(ailerons=1500, elevator=1500, rudder=1500):
    return RXCommand(ailerons, elevator, 1400, rudder, 2000, 2000, ALL_VALID)


class ModeRig:
    """``given`` are the readings and requests that the mode sees in addition to the estimate."""

    def __init__(self, mode, plane=None, *, has_navigation=True, **given):
        self.mode = mode
        self.plane = plane or PointMass()
        self.has_navigation = has_navigation
        self.given = given
        self.demands = []

    @property
    def situation(self):
        plane = self.plane
        orientation = OrientationCommand(plane.roll, plane.pitch, 0.0, 0.0, 0.0, 0.0, 1)
        navigation = plane.state if self.has_navigation else None
        return FlightSituation(plane.time_s, orientation, navigation, **self.given)

    def enter(self):
        self.mode.enter(self.situation)
        return self

    def fly(self, duration_s):
        def demand(_):
            self.demands.append(self.mode.step(self.situation, STEP_S))
            return self.demands[-1]

        return self.plane.fly(demand, duration_s)

    @property
    def path_demand(self):
        assert isinstance(self.demands[-1], PathDemand)
        return self.demands[-1]
