"""``up check``: reports all problems in one run."""

from __future__ import annotations

import argparse
import sys

from up.cli.system import cog_files, cogfile_problems, program_files, system_of
from up.cogs.cog import echo
from up.loading.checking import check_application, no_configuration

EXIT_MISTAKES = 2


def run(values: argparse.Namespace) -> int:
    """Check configuration and module graph; report all problems and warnings."""
    system = system_of(values)
    files = (*cog_files(system.application), *program_files())
    findings = check_application(system.application, system.context, files)
    problems = list(dict.fromkeys([*cogfile_problems(system.application), *findings.problems]))
    nothing = no_configuration(system.context.config_folder, findings.files)
    if nothing and not values.defaults:
        problems.append(nothing)
    for warning in findings.warnings:
        print(f"warning: {warning}", file=sys.stderr)  # noqa: T201 - the user's answer
    for problem in problems:
        print(problem, file=sys.stderr)  # noqa: T201 - the user's answer
    if problems:
        count = len(problems)
        echo(f"{count} {'mistake' if count == 1 else 'mistakes'} to mend")
        return EXIT_MISTAKES
    echo(
        f"all is in order: {len(findings.plan.modules)} modules in the mode"
        f" '{system.context.mode.value}', {len(findings.files)} configuration files"
        f" for {system.context.config_folder}"
    )
    return 0
