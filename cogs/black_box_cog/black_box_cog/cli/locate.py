"""The folder of flights that a verb reads."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from black_box_cog.config import BLACK_BOX
from up.cli.locate import application_of
from up.flight_log.flights_folder import default_folder
from up.flight_log.flights_folder import folder_of as configured_folder
from up.loading.application import NoApplicationError


def folder_of(values: argparse.Namespace) -> Path:
    """Return ``--folder``, otherwise the folder in black_box.yml, otherwise the default one.

    Outside of an application, and without ``--config``, there is no black_box.yml. Raises
    ConfigErrors, and CliError for a ``--file`` that does not exist.
    """
    if values.folder is not None:
        return Path(values.folder)
    config: Path | None = values.config
    if config is None:
        try:
            config = application_of(values).config_folder
        except NoApplicationError:
            return default_folder(os.environ)
    return configured_folder(BLACK_BOX.load(config).folder, os.environ)
