"""One call of pip that installs all missing cogs into this interpreter's environment."""

import importlib.metadata
import os
import subprocess
import sys
import sysconfig
import tempfile
from collections import deque
from collections.abc import Sequence
from pathlib import Path

from up.cogs.cog import CogError
from up.cogs.cogfile import WantedCog
from up.cogs.installed import distribution_of
from up.cogs.source_tree import (
    builds_with_setuptools,
    distribution_name,
    neighbours,
    normal_name,
)
from up.fields import printable
from up.output import StatusLine, echo

FRAMEWORK = "raspilot"
_SHOWN_LINES = 12
_SHOWN_COLUMNS = 70


def install(missing: Sequence[WantedCog], in_tree: Sequence[WantedCog]) -> None:
    """Install cogs; raises CogError with pip's last lines and one sentence.

    All folders go to one pip call, which resolves their dependencies on each other. ``in_tree`` are
    all path cogs of the Cogfile: their names, and those of the folders beside them, are never
    fetched from the index, whichever package depends on them.
    """
    check_environment()
    folders = [each for each in missing if each.folder is not None]
    remote = [each for each in missing if each.folder is None]
    # pip does not reinstall from a repository while the version number is unchanged.
    replaced = [each for each in remote if each.spec.url and distribution_of(each.cog)]
    with tempfile.TemporaryDirectory(prefix="up-gather-") as scratch:
        constraints = Path(scratch, "constraints.txt")
        given = {each.folder for each in folders if each.folder is not None}
        constraints.write_text(_constraints(in_tree, given), encoding="utf-8")
        command = [sys.executable, "-P", "-m", "pip", "install", "--no-input"]
        command += ["--progress-bar=off", "--disable-pip-version-check", "--use-pep517"]
        command += ["--constraint", str(constraints)]
        here = ["--no-build-isolation"] if _can_build(given) else []
        for options, cogs in (
            (here, folders),
            ([], remote),
            (["--force-reinstall", "--no-deps"], replaced),
        ):
            if cogs:
                wanted = [word for each in cogs for word in _arguments(each)]
                run_pip([*command, *options, *wanted])


def run_pip(command: Sequence[str]) -> None:
    """Run pip; raises CogError with its last lines and one sentence.

    A terminal shows pip's newest line: on a Raspberry Pi all cogs take minutes.
    """
    last: deque[str] = deque(maxlen=_SHOWN_LINES)
    progress = StatusLine()
    environ = {**os.environ, "PIP_NO_COLOR": "1", "GIT_TERMINAL_PROMPT": "0"}
    try:
        with subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env=environ,
        ) as process:
            for line in process.stdout or ():
                last.append(line.rstrip())
                progress.show(f"  pip: {printable(line.strip())[:_SHOWN_COLUMNS]}")
    except OSError as error:
        raise CogError(f"pip cannot be run: {error}", code="pip_failed") from error
    finally:
        progress.clear()
    if process.returncode != 0:
        for line in last:
            echo(f"  pip: {line}", "pip_output", line=line)
        text = f"pip could not install the missing cogs (exit status {process.returncode})"
        raise CogError(text, "pip_failed", status=process.returncode)


def check_environment() -> None:
    """Raise CogError if pip cannot install into this interpreter's environment."""
    place = Path(sysconfig.get_path("purelib"))
    if sys.prefix == sys.base_prefix:
        marker = Path(sysconfig.get_path("stdlib"), "EXTERNALLY-MANAGED")
        if marker.exists():
            raise CogError(
                "this Python belongs to the operating system, which does not let pip change it:"
                " make a virtual environment (python3 -m venv) and run 'up' from there",
                code="environment_managed",
            )
    if not os.access(place, os.W_OK):
        raise CogError(
            f"{place} cannot be written: run 'up gather' as the owner of that environment",
            code="environment_readonly",
        )
    try:
        importlib.metadata.distribution(FRAMEWORK)
    except importlib.metadata.PackageNotFoundError:
        raise CogError(
            f"Up itself is not installed in {sys.prefix}, and pip would look for it on the"
            " package index: install it first, with 'pip install -e .' in its folder",
            code="framework_missing",
        ) from None


def _arguments(wanted: WantedCog) -> list[str]:
    if wanted.folder is not None:
        return ["--editable", str(wanted.folder)]
    if wanted.spec.url:
        address = "git+" + wanted.spec.url.removeprefix("git+")
        return [f"{address}@{wanted.spec.revision}" if wanted.spec.revision else address]
    version = f"=={wanted.spec.version}" if wanted.spec.version else ""
    return [f"{wanted.spec.pypi}{version}"]


def _constraints(in_tree: Sequence[WantedCog], explicit: set[Path]) -> str:
    """Return pip constraints that bind every name of the tree to its folder."""
    known: dict[str, Path] = {}
    for each in in_tree:
        if each.folder is not None:
            known.update(neighbours(each.folder))
    framework = Path(__file__).resolve().parents[2] / "cogs"
    if framework.is_dir():
        known.update(neighbours(framework / "_"))
    given = {normal_name(distribution_name(folder)) for folder in explicit}
    lines = [
        f"{name} @ {folder.as_uri()}"
        for name, folder in sorted(known.items())
        if name not in given and not _is_there(name)
    ]
    return "".join(f"{line}\n" for line in lines)


def _is_there(name: str) -> bool:
    try:
        importlib.metadata.distribution(name)
    except importlib.metadata.PackageNotFoundError:
        return False
    return True


def _can_build(folders: set[Path]) -> bool:
    """Return whether setuptools is installed, so that the build needs no network."""
    if not all(builds_with_setuptools(folder) for folder in folders):
        return False
    try:
        version = importlib.metadata.version("setuptools")
    except importlib.metadata.PackageNotFoundError:
        return False
    numbers = [int(part) for part in version.split(".")[:2] if part.isdigit()]
    # Before 70.1 setuptools needed another distribution to build wheels.
    return numbers >= [70, 1] or _is_there("wheel")
