"""The module that keeps plans, behind an aircraft of a test: real checks, real answers."""

from dataclasses import replace
from pathlib import Path

from tests.raspilot.mission.plans_rig import PlansRig
from tests.raspilot.navigation_rig import NAVIGATION
from up.commands.mission_commands import (
    MissionCommitCommand,
    MissionItemCommand,
    MissionPartCommand,
    MissionRequestCommand,
)
from up.commands.navigation_commands import HomeCommand
from up.flight_modes.navigation_state import LocalFrame, Point

COMMANDS = (MissionCommitCommand, MissionItemCommand, MissionPartCommand, MissionRequestCommand)


class Plans:
    """Takes the Commands of plans near a home (latitude, longitude, altitude)."""

    def __init__(self, folder, home):
        self._rig = PlansRig(Path(folder))
        frame = LocalFrame(home[0], home[1])
        position, still = Point(0.0, 0.0), Point(0.0, 0.0)
        self._rig.state(in_flight=False)
        self._rig.navigation.set(
            replace(NAVIGATION, frame=frame, position=position, velocity_m_s=still)
        )
        self._rig.frame()
        assert self._rig.outcome(HomeCommand(*home)) == [None]
        self.answers = {each.NAME: self._answer_to(each) for each in COMMANDS}

    @property
    def telemetry(self):
        return dict(self._rig.plans.telemetry_content)

    def _answer_to(self, cls):
        def answer(message):
            sent = self._rig.ground.sent
            count = len(sent)
            got = self._rig.outcome(cls.from_data(message["data"]))
            # The disk's answer reaches the reactor after the disk is done.
            while not got:
                self._rig.settle()
            said = [(each.NAME, each.data) for each in sent[count:]]
            if got == [None]:
                return [*said, ("up.ack", {"id": message["id"]})]
            error = got[0].value
            nack = {"code": error.code.value, "reason": error.reason, "detail": error.detail}
            return [*said, ("up.nack", {"id": message["id"], **nack})]

        return answer
