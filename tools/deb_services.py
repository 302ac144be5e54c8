"""The services that have a Debian package: their files, and the scripts of their packages."""

from __future__ import annotations

import configparser
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import raspilot.main
import up_ground.main
import up_proxy.main
import up_runner.main
from up.cli.option_parser import OptionParser, parser_in

SCRIPTS = Path(__file__).parent / "debian"
PREFIX, UNIT_PREFIX = "/usr/lib/raspilot", "/opt/raspilot"
SHARED_STATE = "raspilot"
"""Folder of the flights of daemon and runner's instances; it belongs to raspilot-common."""
STATE = {
    "StateDirectory": "/var/lib",
    "CacheDirectory": "/var/cache",
    "LogsDirectory": "/var/log",
    "RuntimeDirectory": "/run",
}


@dataclass(frozen=True, slots=True)
class Service:
    """A package and its unit of the same name.

    ``files`` are patterns in ``config/``, less ``others``. ``owner`` may write the folder of the
    configuration.
    """

    name: str
    about: str
    main: Callable[[list[str]], object]
    program: str
    files: tuple[str, ...] = ()
    others: tuple[str, ...] = ()
    owner: str = ""

    @property
    def folder(self) -> str:
        return f"/etc/{self.name}"

    @property
    def parser(self) -> OptionParser:
        parser = parser_in(self.main)
        parser.prog = self.program
        return parser

    def config_files(self, config: Path) -> dict[str, Path]:
        """Return the templates of the configuration by their path on the target."""
        found = sorted(each for pattern in self.files for each in config.glob(pattern))
        kept = [each for each in found if each.name not in self.others]
        if not self.files:
            return {f"{self.folder}.env": SCRIPTS / f"{self.name}.env"}
        return {f"{self.folder}/{each.relative_to(config)}": each for each in kept}

    def state(self, unit: str) -> list[str]:
        """Return what a purge removes: configuration and the folders that the unit names."""
        parser = configparser.ConfigParser(strict=False, interpolation=None)
        parser.read_string(unit)
        found = [self.folder]
        for option, parent in STATE.items():
            for name in parser["Service"].get(option, "").split():
                if name != SHARED_STATE:
                    found += [f"{parent}/{name}", f"{parent}/private/{name}"]
        return found

    def scripts(self, unit: str) -> dict[str, str]:
        values = {
            "NAME": self.name,
            "UNIT": f"{self.name}.service",
            "OWNED": f"install -d -o {self.owner} {self.folder}" if self.owner else ":",
            "STATE": " ".join(self.state(unit)),
        }
        words = re.compile(rf"\b({'|'.join(values)})\b")
        return {
            name: words.sub(lambda found: values[found[1]], script_text(name))
            for name in ("postinst", "prerm", "postrm")
        }


SERVICES = (
    Service(
        "up-proxy",
        "relay between aircraft and ground stations",
        up_proxy.main.main,
        "up-proxy",
        ("proxy.yml",),
    ),
    Service(
        "up-runner",
        "starts a Raspilot for each aircraft whose phone requests one",
        up_runner.main.main,
        "up-runner",
        ("runner.yml", "blackbox/*.yml"),
        owner="raspilot",
    ),
    Service(
        "up-ground",
        "ground station of Raspilot, a page for browsers",
        up_ground.main.main,
        "up-ground",
    ),
    Service(
        "raspilot",
        "autopilot for model aeroplanes",
        partial(raspilot.main.main, start=Path()),
        f"{PREFIX}/bin/python -m raspilot",
        ("*.yml",),
        # Of other programs, and the gains, which the daemon writes.
        ("proxy.yml", "runner.yml", "pids.yml"),
        "raspilot",
    ),
)


def script_text(name: str) -> str:
    """Return a file of tools/debian."""
    return (SCRIPTS / name).read_text(encoding="utf-8")


def unit_of(text: str) -> str:
    """Return a unit as the package has it: its paths, and without how to install it by hand."""
    return text[text.index("[Unit]") :].replace(UNIT_PREFIX, PREFIX)
