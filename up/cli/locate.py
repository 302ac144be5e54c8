"""Finds the application of a verb."""

from __future__ import annotations

import argparse
from pathlib import Path

from up.cli.cli_error import UsageError
from up.loading.application import UP_FILE, Application


def application_of(values: argparse.Namespace) -> Application:
    """Return the application that ``--file`` or the current folder belongs to.

    Raises NoApplicationError or ConfigErrors, UsageError for a ``--file`` that does not exist.
    """
    start = Path(values.file) if values.file else Path.cwd()
    if start.name == UP_FILE and start.is_file():
        start = start.parent
    if not start.is_dir():
        text = f"--file {values.file}: neither an application's folder nor its {UP_FILE}"
        raise UsageError(text, "file_missing")
    return Application.find(start)
