"""The services that every module receives before any other call."""

from dataclasses import field
from pathlib import Path
from random import Random, SystemRandom
from typing import Any, TypeVar

from up.config import ConfigFile
from up.config.application import APPLICATION, ApplicationConfig
from up.mode import Mode
from up.quick_dataclass import dataclass

_T = TypeVar("_T")


@dataclass(slots=True)
class Context:
    """The reactor, its clock, the mode and the configuration of this run.

    Modules take all external services from this object, so that a test can replace them: a
    ``task.Clock`` is a reactor whose time the test controls. ``random`` supplies values that others
    must not guess, and jitter; it comes from the system, or from a seed in a simulation.
    """

    reactor: Any
    mode: Mode
    config_folder: Path
    values: dict[ConfigFile[Any], Any] = field(default_factory=dict)
    instance: str = ""
    random: Random = field(default_factory=SystemRandom)

    def config(self, file: ConfigFile[_T]) -> _T:
        """Return the values of a configuration file, read once; raises ConfigErrors."""
        if file not in self.values:
            self.values[file] = file.load(self.config_folder)
        value: _T = self.values[file]
        return value

    @property
    def application(self) -> ApplicationConfig:
        return self.config(APPLICATION)
