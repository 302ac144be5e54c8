"""A small aircraft that keeps plans as a real one does."""

from raspilot.mission.store import PlanStore
from tests.ground.aircraft import Aircraft
from up.commands.mission_commands import (
    MissionCommitCommand,
    MissionPartCommand,
    MissionRequestCommand,
)
from up.commands.refusal import CommandRefusedError


class Flying(Aircraft):
    """An aircraft that keeps plans; `problems` are what its check finds in each of them.

    It does not save the plans of `refused_ids`.
    """

    def __init__(self, port, folder):
        self.stores = {plan: PlanStore(plan, folder) for plan in ("mission", "fence")}
        self.problems = {}
        self.refused_ids = set()
        answers = {
            "up.mission.part": lambda message: self._do(message, MissionPartCommand, self._part),
            "up.mission.commit": lambda message: self._do(
                message, MissionCommitCommand, self._commit
            ),
            "up.mission.request": lambda message: self._do(
                message, MissionRequestCommand, self._request
            ),
        }
        super().__init__(port, answers)

    def _do(self, message, cls, carry_out):
        command = cls.from_data(message["data"])
        try:
            told = carry_out(self.stores[command.plan], command) or []
        except CommandRefusedError as error:
            nack = {"id": message["id"], "code": error.code.value, "reason": error.reason}
            return [*self._told(command), ("up.nack", {**nack, "detail": error.detail})]
        return [*told, ("up.ack", {"id": message["id"]})]

    def _told(self, command):
        if isinstance(command, MissionCommitCommand) and self.problems.get(command.plan):
            data = {"plan": command.plan, "plan_id": command.plan_id}
            problems = self.problems[command.plan]
            yield "up.mission.problems", {**data, "problems": problems, "untold": 2}

    def _part(self, store, command):
        store.stage(command)

    def _commit(self, store, command):
        items, _ = store.staged(command)
        if command.plan_id in self.refused_ids:
            raise CommandRefusedError("disk full", detail="plan_not_saved")
        if self.problems.get(command.plan):
            raise CommandRefusedError("too far", detail="plan_invalid")
        store.use(tuple(items), command.plan_id)

    def _request(self, store, command):
        part = store.part(command)
        return [(part.NAME, part.data)]
