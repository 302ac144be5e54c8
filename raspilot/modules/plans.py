"""The mission and the fence in use: upload, read back, progress, telemetry (docs/mission.md)."""

from collections.abc import Mapping
from typing import Any

from twisted.internet.defer import Deferred, DeferredLock
from twisted.python.failure import Failure

from raspilot.failsafe.config import FAILSAFE
from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.flight_modes.loiter import LOITER
from raspilot.flight_modes.return_home import RETURN
from raspilot.mission.check import Circumstances, check_fence, check_mission
from raspilot.mission.config import MISSION_FILE
from raspilot.mission.progress import NOT_FLOWN, MissionProgress
from raspilot.mission.store import PlanStore, Problem
from raspilot.navigation.planning import distance_m
from up.base_periodic_module import BasePeriodicModule
from up.commands.flight_state_command import FlightStateCommand
from up.commands.mission_commands import (
    FENCE,
    MISSION,
    PART_ITEMS,
    PLANS,
    MissionCommitCommand,
    MissionItemCommand,
    MissionPartCommand,
    MissionProblemsCommand,
    MissionRequestCommand,
)
from up.commands.refusal import Code, CommandRefusedError
from up.flight_modes.flight_mode import FlightMode
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import Point
from up.mission.items import RETURN as RETURN_ITEM
from up.mission.items import PlanItem, plan_id
from up.mode import WITH_BOARD
from up.needs import needs, wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider
from up.system.disk_thread import DiskThread


class PlanInvalidError(Exception):
    """A plan with problems."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__(f"{len(problems)} problems")
        self.problems = problems


class Plans(BasePeriodicModule):
    """Keeps the mission and the fence; checks them and uses each of them only as a whole.

    Checks run beside the reactor. The mission is checked again when home or the fence changes:
    ``problems`` are the result, None before the first one.
    """

    MODES = WITH_BOARD
    CONFIG = MISSION_FILE
    IS_SET_BY_GROUND = True

    flight = needs(FlightModeManager)
    mission_control = wants(BaseMissionControlProvider)

    def on_init(self) -> None:
        self._stores = {plan: PlanStore(plan, self.context.config_folder) for plan in PLANS}
        self.missions, self.fences = self._stores[MISSION], self._stores[FENCE]
        self._disk = DiskThread(self.context.reactor)
        self._turn = DeferredLock()
        self._checked: object = None
        self._was_in_flight: bool | None = None
        self.problems: list[Problem] | None = None
        for plan, store in self._stores.items():
            if problem := store.load():
                self.log.error("{reason}", reason=str(problem), code=problem.code)
                self.up.vetoes.set(f"{plan}.json", str(problem))
        self._progress = self._resumed()
        executor = self.up.command_executor
        executor.register_command(MissionPartCommand, self._on_part)
        executor.register_command(MissionCommitCommand, self._on_commit)
        executor.register_command(MissionRequestCommand, self._on_request)
        executor.register_command(MissionItemCommand, self._on_item)
        executor.register_command(FlightStateCommand, self._on_flight_state)

    @property
    def progress(self) -> MissionProgress:
        """Return what of the mission is flown; set, it is saved for a restart."""
        return self._progress

    @progress.setter
    def progress(self, progress: MissionProgress) -> None:
        previous, self._progress = self._progress, progress
        self.flight.home.memory.update(mission=progress)
        if progress.is_finished and not previous.is_finished:
            self.log.info("the mission is finished", code="mission_finished")
        elif progress.item != previous.item or progress.plan_id != previous.plan_id:
            self.log.info("mission item {item}", item=progress.item, code="mission_item")

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the plans in use, and how far the mission is flown."""
        missions, fences, progress = self.missions, self.fences, self._progress
        return {
            "mission": {
                "id": missions.plan_id,
                "count": len(missions.items),
                "item": progress.item if missions.items else None,
                "distance": self._distance_m(),
                "is_finished": progress.is_finished,
            },
            "fence": {"id": fences.plan_id, "count": len(fences.items)},
        }

    def _distance_m(self) -> float | None:
        situation = self.flight.situation
        if situation is None or situation.navigation is None or not self.missions.items:
            return None
        item: Any = self.missions.items[self._progress.item - 1]
        state, home = situation.navigation, situation.home
        point = None if item.latitude_deg is None else state.frame.point(
            item.latitude_deg, item.longitude_deg
        )  # fmt: skip
        if item.kind == RETURN_ITEM and home is not None:
            point = home.point
        return None if point is None else distance_m(state.position, point)

    def _resumed(self) -> MissionProgress:
        """Return the progress of the flight that another run of the program began."""
        saved, items = self.flight.home.memory.values.mission, self.missions.items
        if saved is None or saved.plan_id != self.missions.plan_id:
            return self._begun()
        if max(saved.item, saved.start) > len(items):
            return self._begun()
        kinds: Any = items[saved.item - 1]
        return self._begun() if kinds.kind in NOT_FLOWN else saved

    def _begun(self, number: int = 1) -> MissionProgress:
        items: Any = self.missions.items
        return MissionProgress(self.missions.plan_id).at(items, number)

    def _circumstances(self) -> Circumstances:
        context, place = self.context, self.flight.home.place
        situation = self.flight.situation
        state = None if situation is None else situation.navigation
        borders: Any = self.fences.items
        return Circumstances(
            self.config,
            context.config(NAVIGATION),
            context.config(FAILSAFE).fence,
            borders,
            None if place is None else (place.latitude_deg, place.longitude_deg, place.altitude_m),
            Point(0.0, 0.0) if state is None else state.wind_m_s,
            context.config(LOITER).radius_m,
            context.config(RETURN).radius_m,
            frozenset(each.NAME for each in self.up.get_modules(FlightMode)),
        )

    @property
    def _key(self) -> object:
        return self.flight.home.place, self.missions.plan_id, self.fences.plan_id

    def on_period(self) -> None:
        if self._turn.locked or self._checked == (key := self._key):
            return
        self._checked = key
        items: Any = self.missions.items
        given = self._circumstances()
        done: Deferred[list[Problem]] = self._disk.run(
            lambda: check_mission(items, given) if items else []
        )
        done.addCallbacks(self._on_checked, self._on_fault, callbackArgs=(key,))

    def _on_checked(self, problems: list[Problem], key: object) -> None:
        if key == self._key:
            self.problems = problems
            for each in problems[:PART_ITEMS]:
                self.log.warn(
                    "mission item {item}: {text}", item=each.item, text=each.text, code=each.code
                )

    def _on_fault(self, failure: Failure) -> None:
        self.log.failure("the check failed", failure, code="check_failed")

    def _on_part(self, command: MissionPartCommand) -> None:
        self._stores[command.plan].stage(command)

    def _on_commit(self, command: MissionCommitCommand) -> Deferred[None]:
        done: Deferred[None] = self._turn.run(self._commit, command)
        return done

    def _commit(self, command: MissionCommitCommand) -> Deferred[None]:
        store = self._stores[command.plan]
        in_use = (store.plan_id, len(store.items))
        # A commit that is repeated does not begin the mission again; home or wind may be others.
        is_in_use = bool(command.count) and in_use == (command.plan_id, command.count)
        staged, wrong = (store.items, []) if is_in_use else store.staged(command)
        items, given, mission = tuple(staged), self._circumstances(), self.missions.items

        def examine() -> None:
            if not wrong and plan_id(items) != command.plan_id:
                text = "the parts are not those of this plan; send them again"
                raise CommandRefusedError(text, detail="plan_changed")
            problems = wrong or self._problems(command.plan, items, mission, given)
            if problems:
                raise PlanInvalidError(problems)
            if not is_in_use:
                store.save(items)

        done = self._disk.run(examine)
        return done.addCallbacks(
            lambda _: None if is_in_use else self._use(store, items, command.plan_id),
            self._on_refused,
            errbackArgs=(command,),
        )

    def _problems(
        self, plan: str, items: tuple[PlanItem, ...], mission: Any, given: Circumstances
    ) -> list[Problem]:
        some: Any = items
        if not items:
            return []
        if plan == MISSION:
            return check_mission(some, given)
        return check_fence(some, mission, given)

    def _use(self, store: PlanStore, items: tuple[PlanItem, ...], identity: str) -> None:
        store.use(items, identity)
        self.up.vetoes.clear(f"{store.plan}.json")
        if store.plan == MISSION:
            self._checked, self.problems = self._key, []
            self.progress = self._begun()
        self.log.info(
            "{plan} {id} with {count} items is in use",
            plan=store.plan, id=identity, count=len(items), code="plan_used",
        )  # fmt: skip

    def _on_refused(self, failure: Failure, command: MissionCommitCommand) -> Failure:
        error: Any = failure.value
        if failure.check(PlanInvalidError):
            problems = error.problems
            listed = tuple(each._asdict() for each in problems[:PART_ITEMS])
            untold = len(problems) - len(listed)
            self._send(MissionProblemsCommand(command.plan, command.plan_id, listed, untold))
            first = problems[0]
            where = f"item {first.item}: " if first.item else ""
            text = f"{where}{first.text} ({len(problems)} problems)"
            raise CommandRefusedError(text, detail="plan_invalid")
        if failure.check(OSError):
            reason = error.strerror or failure.getErrorMessage()
            text = f"{command.plan}.json was not saved: {reason}"
            raise CommandRefusedError(text, Code.FAILED, detail="plan_not_saved")
        return failure

    def _on_request(self, command: MissionRequestCommand) -> None:
        if not self._send(self._stores[command.plan].part(command)):
            raise CommandRefusedError("the ground station is not connected", Code.UNAVAILABLE)

    def _send(self, command: MissionPartCommand | MissionProblemsCommand) -> bool:
        return self.mission_control is not None and self.mission_control.send_command(command)

    def _on_item(self, command: MissionItemCommand) -> None:
        count = len(self.missions.items)
        if command.item > count:
            text = f"the mission has {count} items"
            detail = "no_item" if count else "no_mission"
            raise CommandRefusedError(text, detail=detail)
        self.progress = self._begun(command.item)

    def _on_flight_state(self, command: FlightStateCommand) -> None:
        """Begin the mission again when a flight is over."""
        if command.is_in_flight is False and self._was_in_flight is not False:
            self.progress = self._begun()
        self._was_in_flight = command.is_in_flight
