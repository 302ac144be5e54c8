"""Finds the application of a verb."""

import argparse
from contextlib import suppress
from pathlib import Path

from up.cli.cli_error import UsageError
from up.loading.application import UP_FILE, Application, NoApplicationError


def application_of(values: argparse.Namespace) -> Application:
    """Return the application that ``--file`` or the current folder belongs to.

    ``--file`` is a path, or else the name of an installed application.

    Raises NoApplicationError or ConfigErrors, UsageError for a ``--file`` that does not exist.
    """
    start = Path(values.file) if values.file else Path.cwd()
    if start.name == UP_FILE and start.is_file():
        start = start.parent
    if not start.is_dir():
        with suppress(NoApplicationError):
            return Application.installed(values.file)
        text = (
            f"--file {values.file}: neither an application's folder, nor its {UP_FILE}, nor the"
            " name of an installed application"
        )
        raise UsageError(text, "file_missing")
    return Application.find(start)
