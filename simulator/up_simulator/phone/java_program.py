"""Finds the Java phone: a JVM and the jars, built from their sources where a JDK is."""

from __future__ import annotations

import contextlib
import fcntl
import shutil
import subprocess
import zipfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

ANDROID = Path(__file__).resolve().parents[3] / "android"
JARS = ("up-core.jar", "virtual-phone.jar")
SOURCES = ("core/src", "virtual/src")
MAIN = "org.raspilot.up.virtual_phone.VirtualPhone"
LONGEST_S = 300.0
QUICK_START = (
    "-Xshare:auto",
    "-XX:TieredStopAtLevel=1",
    "-XX:+UseSerialGC",
    "-XX:-UsePerfData",
    "-Xms16m",
    "-Xmx64m",
)
"""A JVM for a flight of seconds: there in a fifth of a second, with one collector's thread."""
PACKAGE = "default-jdk-headless"


class JavaUnavailableError(Exception):
    """The Java phone cannot be had here: the message is one sentence for the user."""


@dataclass(frozen=True, slots=True)
class JavaProgram:
    """A JVM and the jars."""

    java: str
    jars: tuple[Path, ...]

    def command(self, *options: str, main: str = MAIN) -> list[str]:
        """Return the command line of a program of the jars."""
        path = ":".join(map(str, self.jars))
        return [self.java, *QUICK_START, "-cp", path, main, *options]


def find_java_program(
    say: Callable[[str], None] = lambda _text: None, android: Path = ANDROID
) -> JavaProgram:
    """Return the Java phone, rebuilt if its sources are newer than its jars.

    ``say`` reports in one sentence if outdated jars are used. Raises JavaUnavailableError.
    """
    java = shutil.which("java")
    if java is None:
        raise JavaUnavailableError(f"there is no java (Debian package {PACKAGE})")
    jars = tuple(android / "build" / name for name in JARS)
    if not _are_fresh(jars, android):
        try:
            _build(android)
        except JavaUnavailableError as error:
            if not all(map(zipfile.is_zipfile, jars)) or not _lacks_tools():
                raise
            say(f"the Java phone was built before and is not built anew: {error}")
    return JavaProgram(java, jars)


def _are_fresh(jars: Iterable[Path], android: Path) -> bool:
    """Return whether the jars are there and whole, and no source is newer."""
    if not all(map(zipfile.is_zipfile, jars)):
        return False
    oldest_s = min(jar.stat().st_mtime for jar in jars)
    folders = (android / name for name in SOURCES)
    # A folder is newer, too, when something in it went away.
    sources = (path for folder in folders for path in (folder, *folder.rglob("*")))
    return all(path.stat().st_mtime <= oldest_s for path in sources if path.exists())


def _lacks_tools() -> list[str]:
    return [name for name in ("make", "javac") if shutil.which(name) is None]


def _build(android: Path) -> None:
    if not (android / "Makefile").is_file():
        raise JavaUnavailableError(f"the Java phone's sources are not here: there is no {android}")
    lacking = _lacks_tools()
    if lacking:
        raise JavaUnavailableError(
            f"building the Java phone needs {', '.join(lacking)} (Debian packages make {PACKAGE})"
        )
    with _lock(android / "build"):
        for name in JARS:
            # A full disk leaves files that make would take for complete.
            if not zipfile.is_zipfile(android / "build" / name):
                (android / "build" / name).unlink(missing_ok=True)
        try:
            done = subprocess.run(
                ["make", "-C", str(android), "core", "virtual"],
                capture_output=True,
                text=True,
                timeout=LONGEST_S,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            why = f"building the Java phone needs more than {LONGEST_S:g} s"
            raise JavaUnavailableError(why) from error
        if done.returncode:
            reason = _reason(done.stdout + done.stderr)
            raise JavaUnavailableError(f"the Java phone does not compile: {reason}")
        # A build without work counts as fresh all the same.
        for name in JARS:
            (android / "build" / name).touch()


@contextlib.contextmanager
def _lock(build: Path) -> Iterator[None]:
    """Let one process build, and make others wait for it."""
    try:
        build.mkdir(exist_ok=True)
        lock = (build / ".lock").open("w")
    except OSError as error:
        why = f"{build} cannot be written: {error.strerror}"
        raise JavaUnavailableError(why) from error
    with lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _reason(said: str) -> str:
    """Return the most informative line of make's output: the first error, or the last line."""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    errors = [line for line in lines if "error:" in line or "needs" in line]
    return (errors or lines[-1:] or ["make said nothing"])[0]
