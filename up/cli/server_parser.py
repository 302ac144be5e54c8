"""The command line of a server program: up-proxy, up-runner."""

import argparse
from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from up.cli.option_parser import EXIT_USAGE, OptionParser, add_defaults_option, whole_number
from up.config import ConfigFile, no_configuration
from up.errors import UserError
from up.output import print_problems
from up.version import VERSION


class ServerParser(OptionParser):
    """Options for the folder of the configuration, the ports, and the log level."""

    def __init__(self, file: ConfigFile[Any], ports: Sequence[str], **texts: Any) -> None:
        super().__init__(**texts)
        self._file = file
        text = f"folder of {file.filename} (default: config)"
        self.add_argument("--config", type=Path, metavar="DIR", help=text)
        add_defaults_option(self)
        for option in ports:
            self.add_argument(
                option, type=whole_number(0, 65535), metavar="N", help="TCP port; 0: any free port"
            )
        self.add_argument("--log-level", choices=("debug", "info", "warning", "error"))
        self.add_argument("--version", action="version", version=f"{self.prog} {VERSION}")

    def load(
        self, arguments: Sequence[str] | None, default: Path
    ) -> tuple[argparse.Namespace, Path, Any]:
        """Return options, folder and configuration, with the keys that the options override.

        A folder that was named and lacks the file is refused unless ``--defaults``. Ends the
        program with EXIT_USAGE after printing every mistake.
        """
        options = self.parse_args(arguments)
        folder = options.config or default
        try:
            if options.config is not None and not folder.is_dir():
                text = f"--config {folder}: no such folder"
                raise UserError(text, "folder_missing", folder=folder)
            nothing = no_configuration(folder, [self._file])
            if options.config is not None and nothing is not None and not options.defaults:
                raise nothing
            config = self._file.load(folder)
        except UserError as error:
            print_problems(error.problems)
            self.exit(EXIT_USAGE)
        given = {name: value for name, value in vars(options).items() if value is not None}
        keys = {each.name for each in fields(config)} & set(given)
        return options, folder, replace(config, **{name: given[name] for name in keys})
