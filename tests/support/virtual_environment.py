"""Real virtual environments with this project and its dependencies, but without cogs."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
LIMIT_S = 300


class VirtualEnvironment:
    """A virtual environment in a folder, made by ``python -m venv``.

    Two lines in a .pth file let it import the framework and its dependencies from where the tests
    run; what other people have installed there in editable form is not visible.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
        self.packages = next(folder.glob("lib/python3*/site-packages"))
        shared = f"{REPOSITORY}\n{sysconfig.get_path('purelib')}\n"
        (self.packages / "zz_shared.pth").write_text(shared)
        self.python = folder / "bin" / "python"

    def run(
        self,
        *arguments: str | Path,
        cwd: Path,
        environ: Mapping[str, str] | None = None,
        status: int | None = 0,
    ) -> subprocess.CompletedProcess[str]:
        """Run this environment's Python; stdin is empty. ``status``: what must come of it."""
        done = subprocess.run(
            [self.python, *arguments],
            cwd=cwd,
            env=self.environ(environ),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=LIMIT_S,
            check=False,
        )
        if status is not None and done.returncode != status:
            raise AssertionError(f"exit status {done.returncode}\n{done.stdout}\n{done.stderr}")
        return done

    def up(
        self,
        *arguments: str | Path,
        cwd: Path,
        environ: Mapping[str, str] | None = None,
        status: int | None = 0,
    ) -> subprocess.CompletedProcess[str]:
        """Run the command ``up``."""
        return self.run("-m", "up.cli", *arguments, cwd=cwd, environ=environ, status=status)

    def environ(self, more: Mapping[str, str] | None = None) -> dict[str, str]:
        """Return an environment without this machine's settings of pip and Python."""
        kept = {
            name: text
            for name, text in os.environ.items()
            if not name.startswith(("PIP_", "PYTHON", "UP_", "GIT_"))
        }
        # No index at all, so that only the test's packages are available.
        closed = {"PIP_CONFIG_FILE": os.devnull, "PIP_NO_INDEX": "1", "PIP_NO_CACHE_DIR": "1"}
        # pip's own spelling of --no-build-isolation: setuptools is here and on no test's index.
        closed["PIP_NO_BUILD_ISOLATION"] = "0"
        return {**kept, **closed, **(more or {})}
