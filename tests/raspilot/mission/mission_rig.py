"""MISSION in closed loop: uploaded by Commands, flown by a point mass."""

from dataclasses import replace

from raspilot.flight_modes.mission import Mission
from tests.raspilot.flight_modes.mode_rig import ModeRig
from tests.raspilot.mission.plans_rig import PlansRig
from tests.raspilot.navigation_rig import FRAME, STANDING
from up.flight_modes.flight_mode import Home
from up.flight_modes.navigation_state import Point

HOME = Home(Point(0.0, 0.0), 250.0)


class MissionRig(ModeRig):
    """The aircraft begins at home, 50 m above it, to the north."""

    def __init__(self, folder, data, plane=None, *, modes=(), is_new=True):
        self.plans_rig = rig = PlansRig(folder, (Mission, *modes), gains=None)
        super().__init__(rig.up.get_module(Mission), plane, home=HOME)
        self.plans = rig.plans
        if is_new:
            rig.state(in_flight=False)
            rig.navigation.set(replace(STANDING, position=HOME.point, altitude_m=HOME.altitude_m))
            rig.frame()
            assert rig.upload(data) == [None], rig.ground.sent
        rig.state(in_flight=True)
        self.passed = []

    @property
    def situation(self):
        given = super().situation
        return replace(given, navigation=replace(given.navigation, frame=FRAME))

    def fly(self, duration_s):
        """Fly; ``passed`` are item, time and state at every change of the item."""

        def step(situation, dt_s, fly=self.mode.step):
            item = self.plans.progress.item
            demand = fly(situation, dt_s)
            if self.plans.progress.item != item:
                self.passed.append((item, situation.navigation))
            return demand

        self.mode.step = step
        try:
            return super().fly(duration_s)
        finally:
            del self.mode.step

    @property
    def order(self):
        return [item for item, _ in self.passed]
