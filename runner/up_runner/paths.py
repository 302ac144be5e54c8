"""The paths of the runner, with defaults for those missing in the configuration."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Mapping
from pathlib import Path

from up.quick_dataclass import dataclass
from up_runner.config import RunnerConfig


@dataclass(frozen=True, slots=True)
class Paths:
    """The runner's folders and programs, all absolute."""

    root: Path
    script: Path | None
    """None: the module ``raspilot``."""
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
            script=root / (config.script_path or "main.py")
            if config.script_path or config.application_root
            else None,
            # Not resolved: the symbolic link is what makes it a virtual environment's interpreter.
            python=Path(config.python or sys.executable).absolute(),
            base=config_folder / (config.instance_config or ("blackbox" if black_box else ".")),
            profiles=config_folder / (config.profiles_folder or "profiles"),
            run=run,
            instances=Path(config.instances_folder or _first(environ, "STATE_DIRECTORY") or run),
            logs=Path(config.logs_folder or _first(environ, "LOGS_DIRECTORY") or run / ".logs"),
        )


def own_root() -> Path:
    """Return the source tree that Raspilot runs from, or the working folder without one."""
    spec = importlib.util.find_spec("raspilot")
    tree = Path(spec.origin).resolve().parents[1] if spec and spec.origin else Path.cwd()
    return tree if (tree / "main.py").is_file() else Path.cwd()


def default_run_folder(environ: Mapping[str, str], uid: int) -> Path:
    """Return the default folder of sockets and state."""
    if runtime := _first(environ, "RUNTIME_DIRECTORY"):
        return Path(runtime)
    if environ.get("XDG_RUNTIME_DIR"):
        return Path(environ["XDG_RUNTIME_DIR"], "up-runner")
    return Path(f"/tmp/up-runner-{uid}")


def _first(environ: Mapping[str, str], variable: str) -> str:
    """Return a folder of the service manager, which may name several."""
    return environ.get(variable, "").split(":")[0]
