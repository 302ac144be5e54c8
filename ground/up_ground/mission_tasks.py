"""Tasks of ``up-ground mission`` on the link to an aircraft."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from up.cli.option_parser import EXIT_FAILED, EXIT_OK
from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightModeCommand
from up.commands.mission_commands import FENCE, MISSION, MissionItemCommand
from up.mission.items import PlanItem
from up.mission.plan_transfer import PlanOutcome, PlanTransfer
from up.protocols.general_message import GeneralMessage, encode
from up_ground.command_task import CommandTask
from up_ground.send import Send

NOT_USED = frozenset({"plan_invalid", "plan_incomplete", "plan_changed", "plan_not_saved"})
"""Details of a refusal after which the aircraft uses the plan that it had."""


class TransferTask(CommandTask):
    """Uploads or (None) downloads plans one after the other; ends at the first that fails.

    Before two are uploaded the first one is read: if the aircraft refuses the second, the first is
    restored, so that a file is used as a whole or not at all. ``restored`` is how that ended; None:
    nothing was restored.
    """

    what = "an upload"

    def __init__(self, *args: Any, plans: Mapping[str, Sequence[PlanItem] | None]) -> None:
        super().__init__(*args)
        self.outcomes: dict[str, PlanOutcome] = {}
        self.restored: PlanOutcome | None = None
        self._plans = list(plans.items())
        self._first = self._plans[0][0]
        self._is_reading = len(plans) > 1 and None not in plans.values()
        self._before: Sequence[PlanItem] | None = None
        self._transfer: PlanTransfer | None = None

    def on_ready(self) -> None:
        if self._is_reading:
            self._begin(self._first, None, self._on_read)
        else:
            self._begin(*self._plans.pop(0), self._on_end)

    def on_answer(self, message: GeneralMessage) -> None:
        if self._transfer is not None:
            self._transfer.on_message(message)

    async def stop(self) -> None:
        if self._transfer is not None:
            self._transfer.stop()
        await super().stop()

    def _begin(
        self,
        plan: str,
        items: Sequence[PlanItem] | None,
        on_end: Callable[[PlanOutcome], object],
    ) -> None:
        self._transfer = PlanTransfer(self._reactor, self._send, plan, self._on_progress, on_end)
        if items is None:
            self._transfer.download()
        else:
            self._transfer.upload(items)

    def _send(self, command: BaseCommand, id_: str) -> None:
        needs_beacon = command.NEEDS_BEACON or self.link.status.is_keyed
        beacon = self.telemetry.beacon if needs_beacon else None
        self.link.send(encode(command.NAME, command.data, id_, beacon))

    def _on_progress(self, phase: str, done: int, of: int) -> None:
        if os.isatty(2):
            sys.stderr.write(f"\r{phase} {done} of {of}\x1b[K" + ("\r\x1b[K" if done == of else ""))
            sys.stderr.flush()

    def _on_read(self, outcome: PlanOutcome) -> None:
        self._is_reading = False
        self._before = outcome.items
        if outcome.code:
            self.outcomes[self._first] = outcome
            self.finish(EXIT_FAILED)
        else:
            self.on_ready()

    def _on_end(self, outcome: PlanOutcome) -> None:
        assert self._transfer is not None
        plan = self._transfer.plan
        self.outcomes[plan] = outcome
        before, used = self._before, self.outcomes[self._first].items
        if plan != self._first and outcome.detail in NOT_USED and before not in (None, used):
            self._begin(self._first, before, self._on_restored)
        elif outcome.code:
            self.finish(EXIT_FAILED)
        elif self._plans:
            self.on_ready()
        else:
            self.finish(EXIT_OK)

    def _on_restored(self, outcome: PlanOutcome) -> None:
        self.restored = outcome
        self.finish(EXIT_FAILED)


class StartMission(Send):
    """Selects the next item if one is given, and then the flight mode MISSION."""

    def __init__(self, reactor: Any, settings: Any, tokens: Any, item: int | None) -> None:
        mode = FlightModeCommand("MISSION")
        self._then = [mode] if item is not None else []
        first = mode if item is None else MissionItemCommand(item)
        super().__init__(reactor, settings, tokens, first.NAME, first.data, needs_beacon=True)

    def on_acked(self) -> None:
        if not self._then:
            self.finish(EXIT_OK)
            return
        command = self._then.pop()
        self._use(command.NAME, command.data)
        self.on_ready()


class MissionStatus(CommandTask):
    """Prints what the newest telemetry frame reports of mission and fence."""

    NEEDS_CONTROL = False

    def __init__(self, reactor: Any, settings: Any, tokens: Any, is_json: bool) -> None:
        super().__init__(reactor, settings, tokens)
        self._is_json = is_json

    def on_ready(self) -> None:
        telemetry = self.telemetry
        mode = telemetry.text("flight_control", "mode") or telemetry.text("flight_mode")
        count, borders = telemetry.number(MISSION, "count"), telemetry.number(FENCE, "count")
        item, distance_m = telemetry.number(MISSION, "item"), telemetry.number(MISSION, "distance")
        if self._is_json:
            told = {each: telemetry.data.get(each) for each in (MISSION, FENCE, "flight_mode")}
            self.echo(json.dumps(told, indent=1))
        elif count is None:
            self.fail("this aircraft reports no missions", "not_supported", EXIT_FAILED)
            return
        else:
            text = "no mission"
            if count and item is not None:
                away = "" if distance_m is None else f", {distance_m:.0f} m away"
                text = f"mission {telemetry.text(MISSION, 'id')}: item {item:.0f} of {count:.0f}"
                text += ", finished" if telemetry.flag(MISSION, "is_finished") else away
            self.echo(text)
            self.echo(f"borders of the fence: {borders or 0:.0f}")
            self.echo(f"flight mode: {mode or '--'}")
        self.finish(EXIT_OK)
