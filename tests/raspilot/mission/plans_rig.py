"""A navigation rig with the module Plans, and missions for it."""

from raspilot.flight_modes.return_home import Return
from raspilot.modules.plans import Plans
from tests.raspilot.navigation_rig import FRAME, NavigationRig
from up.commands.mission_commands import MissionCommitCommand, MissionPartCommand
from up.flight_modes.navigation_state import Point
from up.mission.items import ITEM_CLASSES, plan_id


def placed(north, east, *, kind="waypoint", altitude=60.0, **more):
    """Return the data of an item at a place in metres from the rig's frame."""
    latitude, longitude = FRAME.degrees(Point(north, east))
    return {
        "kind": kind, "latitude": latitude, "longitude": longitude, "altitude": altitude, **more
    }  # fmt: skip


SQUARE = [placed(400, 0), placed(400, 400), placed(0, 400), {"kind": "return"}]


def items_of(data, plan="mission"):
    return [ITEM_CLASSES[plan].from_data(each) for each in data]


class PlansRig(NavigationRig):
    """The disk answers as soon as the test asks for it."""

    def __init__(self, folder, modes=(), **more):
        super().__init__(folder, modes=(Return, *modes), modules=(Plans,), **more)
        self.plans = self.up.get_module(Plans)

    def settle(self):
        """Wait for the disk, and let the reactor take its answers."""
        self.plans._disk.wait()
        self.clock.advance(0.0)

    def part(self, data, first=1, plan="mission", count=None, identity=None):
        identity = plan_id(items_of(data, plan)) if identity is None else identity
        some = tuple(data[first - 1 : first + 19])
        return self.outcome(
            MissionPartCommand(plan, identity, count or len(data), first, some)
        )  # fmt: skip

    def commit(self, data, plan="mission", identity=None):
        identity = plan_id(items_of(data, plan)) if identity is None else identity
        got = self.outcome(MissionCommitCommand(plan, identity, len(data)))
        self.settle()
        return got

    def upload(self, data, plan="mission", identity=None):
        for first in range(1, len(data) + 1, 20):
            self.part(data, first, plan, identity=identity)
        return self.commit(data, plan, identity)
