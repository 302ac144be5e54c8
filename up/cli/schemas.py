"""``up schemas``: the JSON Schema of every configuration file."""

from __future__ import annotations

import argparse

from up.cli.system import cog_files, program_files, system_of
from up.cogs.cog import echo
from up.config import write_schemas
from up.loading.application import UP_FILE_CONFIG
from up.loading.checking import check_application


def run(values: argparse.Namespace) -> int:
    """Write one schema per file, and print how to set up an editor."""
    system = system_of(values)
    more = (UP_FILE_CONFIG, *cog_files(system.application), *program_files())
    findings = check_application(system.application, system.context, more)
    for path in write_schemas(findings.files, values.folder):
        echo(str(path))
    echo(
        "An editor with a YAML language server takes one by a first line like"
        " '# yaml-language-server: $schema=config.schema.json'"
    )
    return 0
