"""The paths of the runner, with defaults for those missing in the configuration."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from up_runner.config import RunnerConfig
from up_runner.run_folder import default_run_folder


@dataclass(frozen=True, slots=True)
class Paths:
    """The runner's folders and programs, all absolute."""

    root: Path
    script: Path
    python: Path
    base: Path
    profiles: Path
    run: Path
    instances: Path
    logs: Path

    @classmethod
    def of(
        cls, config: RunnerConfig, config_folder: Path, environ: Mapping[str, str], uid: int
    ) -> Paths:
        config_folder = config_folder.absolute()
        root = Path(config.application_root or own_root()).absolute()
        black_box = config.mode == "black box"
        run = Path(config.run_folder or default_run_folder(environ, uid)).absolute()
        return cls(
            root=root,
            script=root / config.script_path,
            # Not resolved: the symbolic link is what makes it a virtual environment's interpreter.
            python=Path(config.python or sys.executable).absolute(),
            base=_in(config_folder, config.instance_config, "blackbox" if black_box else "."),
            profiles=_in(config_folder, config.profiles_folder, "profiles"),
            run=run,
            instances=Path(config.instances_folder or _first(environ, "STATE_DIRECTORY") or run),
            logs=Path(config.logs_folder or _first(environ, "LOGS_DIRECTORY") or run / ".logs"),
        )


def own_root() -> Path:
    """Return the folder of this package's repository, or the working folder without one."""
    repository = Path(__file__).resolve().parents[2]
    return repository if (repository / "main.py").is_file() else Path.cwd()


def _in(folder: Path, wanted: str, default: str) -> Path:
    return folder / (wanted or default)


def _first(environ: Mapping[str, str], variable: str) -> str:
    return environ.get(variable, "").split(":")[0]
