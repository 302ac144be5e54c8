"""``up-ground mission``: files, and the plans of an aircraft."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from up.cli.cli_error import CliError
from up.cli.option_parser import EXIT_FAILED, EXIT_OK
from up.commands.mission_commands import FENCE, MISSION
from up.config.atomic_writer import create_text
from up.errors import UserError
from up.mission.items import Border, MissionItem, PlanItem
from up.mission.plan import PLAN, WAYPOINTS, Plan, PlanError, PlanProblem, position
from up.mission.plan_forms import MAX_CHARACTERS, read_plan, write_plan
from up.mission.plan_transfer import PlanOutcome
from up.mission.reliable_requests import NO_ANSWER
from up.output import echo
from up_ground.arguments import peer_of
from up_ground.mission_tasks import MissionStatus, StartMission, TransferTask
from up_ground.one_shot_task import EXIT_NO_ANSWER, print_error
from up_ground.one_shot_task import run as run_task
from up_ground.settings import Seat

_WAYPOINT_SUFFIXES = (".waypoints", ".txt", ".wpl")
_NOUNS = {MISSION: "item", FENCE: "border"}


def run(options: argparse.Namespace) -> int:
    """Carry out an action and return the exit status."""
    actions = {
        "check": _check,
        "upload": _upload,
        "download": _download,
        "start": _start,
        "status": _status,
        "clear": _clear,
    }
    return actions[options.action](options)


def _check(options: argparse.Namespace) -> int:
    plan = _opened(options)
    if plan is None:
        return EXIT_FAILED
    if options.json:
        notes = [each.data for each in plan.notes]
        told = {"file": str(options.file), "form": plan.form, "problems": [], "notes": notes}
        counts = {"items": len(plan.items), "borders": len(plan.borders)}
        echo(json.dumps({**told, **counts}, indent=1))
    else:
        counts_text = f"{_count(plan.items, MISSION)}, {_count(plan.borders, FENCE)}"
        echo(f"{options.file}: {counts_text}; the aircraft checks them again")
    return EXIT_OK


def _upload(options: argparse.Namespace) -> int:
    plan = _opened(options)
    if plan is None:
        return EXIT_FAILED
    contents: dict[str, Sequence[PlanItem]] = {FENCE: plan.borders, MISSION: plan.items}
    wanted = {each: contents[each] for each in options.plans if contents[each]}
    if not wanted:
        nouns = " and no ".join(f"{_NOUNS[each]}s" for each in options.plans)
        raise CliError(f"{options.file}: has no {nouns} to upload", code="nothing_to_upload")
    return _transfer(options, wanted, plan.numbers)


def _download(options: argparse.Namespace) -> int:
    path: Path = options.file
    form = WAYPOINTS if path.suffix.lower() in _WAYPOINT_SUFFIXES else PLAN
    plans = options.plans if form == PLAN else tuple(set(options.plans) & {MISSION})
    if os.path.lexists(path) or not plans:
        reason = "exists already" if plans else "a file of waypoints has no place for a fence"
        raise CliError(f"{path}: {reason}; choose another name", code="file_unsuitable")

    def save(task: TransferTask) -> None:
        read = {each: outcome.items for each, outcome in task.outcomes.items()}
        items = [each for each in read.get(MISSION, ()) if isinstance(each, MissionItem)]
        borders = [each for each in read.get(FENCE, ()) if isinstance(each, Border)]
        home = [
            task.telemetry.number("home", each) for each in ("latitude", "longitude", "altitude")
        ]
        text = write_plan(Plan(form, tuple(items), tuple(borders), position(home)))
        if not create_text(path, text):
            raise CliError(f"{path}: exists already", code="file_unsuitable")

    return _transfer(options, dict.fromkeys(plans), save=save)


def _clear(options: argparse.Namespace) -> int:
    options.json = False
    return _transfer(options, {options.plans: ()})


def _start(options: argparse.Namespace) -> int:
    return run_task(
        lambda reactor: StartMission(reactor, *peer_of(options, Seat.COMMAND), options.item)
    )


def _status(options: argparse.Namespace) -> int:
    return run_task(
        lambda reactor: MissionStatus(reactor, *peer_of(options, Seat.LISTEN), options.json)
    )


def _transfer(
    options: argparse.Namespace,
    plans: dict[str, Any],
    numbers: Sequence[int] = (),
    save: Any = None,
) -> int:
    """Transfer plans one after the other; None: it is downloaded."""
    tasks: list[TransferTask] = []

    def make(reactor: Any) -> TransferTask:
        tasks.append(TransferTask(reactor, *peer_of(options, Seat.COMMAND), plans=plans))
        return tasks[0]

    status = run_task(make)
    outcomes, restored = tasks[0].outcomes, tasks[0].restored
    if status == EXIT_OK and save is not None:
        save(tasks[0])
    told = {each: _data(each, outcome, numbers) for each, outcome in outcomes.items()}
    if restored is not None:
        first = next(iter(outcomes))
        del outcomes[first]
        told[first] = {**_data(first, restored, ()), "restored": not restored.code}
    if options.json:
        echo(json.dumps(told, indent=1))
    for plan, outcome in outcomes.items():
        if outcome.code:
            status = EXIT_NO_ANSWER if outcome.code == NO_ANSWER else EXIT_FAILED
            _print_refusal(plan, outcome, numbers)
        elif not options.json:
            code = "plan_in_use" if save is None else "plan_written"
            done = "in use" if save is None else f"written to {options.file}"
            text = f"{plan}: {_count(outcome.items, plan)} {done}"
            echo(text, code, plan=plan, count=len(outcome.items), id=outcome.plan_id)
    if restored is not None:
        _print_restored(first, restored)
    return status


def _opened(options: argparse.Namespace) -> Plan | None:
    """Return the contents of the file; None after its problems are printed."""
    path: Path = options.file
    try:
        plan = _read(path)
    except PlanError as error:
        if options.json:
            problems = [each.data for each in error.found]
            echo(json.dumps({"file": str(path), "problems": problems}, indent=1))
        else:
            for each in error.found:
                print_error(f"{path}: {each}", each.code, **each.fields)
        return None
    for each in plan.notes:
        print_error(f"note: {path}: {each}", each.code, **each.fields)
    return plan


def _read(path: Path) -> Plan:
    with path.open("rb") as file:
        content = file.read(4 * MAX_CHARACTERS)
    try:
        return read_plan(content.decode(), str(path))
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not text (UTF-8)", "not_text") from None


def _count(items: Sequence[PlanItem], plan: str) -> str:
    return f"{len(items)} {_NOUNS[plan]}{'' if len(items) == 1 else 's'}"


def _data(plan: str, outcome: PlanOutcome, numbers: Sequence[int]) -> dict[str, Any]:
    return {
        "code": outcome.code,
        "reason": outcome.reason,
        "detail": outcome.detail,
        "plan_id": outcome.plan_id,
        "count": len(outcome.items),
        "problems": [{**each.data, "number": _number(each, numbers)} for each in outcome.problems],
        "untold": outcome.untold,
    }


def _number(problem: PlanProblem, numbers: Sequence[int]) -> int | None:
    """Return the number in the file of an item that the aircraft names."""
    is_item = problem.plan == MISSION and 0 < problem.item <= len(numbers)
    return numbers[problem.item - 1] if is_item else None


def _print_restored(plan: str, outcome: PlanOutcome) -> None:
    """Report what became of the plan that was replaced before another one was refused."""
    if outcome.code:
        text = f"{plan}: that of the file is in use; the one before is not restored"
        print_error(f"{text}: {outcome.reason}", "not_restored", plan=plan, detail=outcome.detail)
    else:
        text = f"{plan}: restored, as before the upload: {_count(outcome.items, plan)} in use"
        print_error(text, "plan_restored", plan=plan, count=len(outcome.items), id=outcome.plan_id)


def _print_refusal(plan: str, outcome: PlanOutcome, numbers: Sequence[int]) -> None:
    print_error(f"{plan}: {outcome.reason}", outcome.code, plan=plan, detail=outcome.detail)
    for each in outcome.problems:
        number = _number(each, numbers)
        there = f" (number {number} of the file)" if number not in (None, each.item) else ""
        print_error(f"{each}{there}", each.code, **each.fields, number=number)
    if outcome.untold:
        print_error(f"and {outcome.untold} more problems", "untold", untold=outcome.untold)
