"""``up modules``: which modules would be loaded, in which order, and why others are left out."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable

from up.cli.system import cogfile_problems, system_of
from up.cogs.cog import echo
from up.loading.checking import check_application
from up.loading.plan import Plan

EXIT_MISTAKES = 2


def run(values: argparse.Namespace) -> int:
    """Show the plan of the boot."""
    system = system_of(values)
    findings = check_application(system.application, system.context)
    plan = findings.plan
    echo(f"mode: {system.context.mode.value}")
    echo("loaded, in this order:")
    _table((str(place), name, origin) for place, name, origin in _loaded(plan))
    if plan.rejected:
        echo("not loaded:")
        _table(("", each.path, each.reason) for each in plan.rejected)
    if plan.commands:
        echo("Commands besides those of Up:")
        _table(("", cls.NAME, f"{cls.__module__}.{cls.__qualname__}") for cls in plan.commands)
    for problem in (*cogfile_problems(system.application), *findings.problems):
        print(problem, file=sys.stderr)  # noqa: T201 - the user's answer
    return EXIT_MISTAKES if findings.problems else 0


def _loaded(plan: Plan) -> Iterable[tuple[int, str, str]]:
    for place, module in enumerate(plan.modules, 1):
        yield place, module.path, plan.origins.get(module.path, "")


def _table(rows: Iterable[tuple[str, str, str]]) -> None:
    lines = list(rows)
    width = max((len(name) for _, name, _ in lines), default=0)
    for first, name, last in lines:
        echo(f"  {first:>2}  {name:<{width}}  {last}")
