"""Chooses the phone aboard; finds the Java one, built from its sources where a JDK is."""

from __future__ import annotations

import contextlib
import fcntl
import shutil
import subprocess
import zipfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.user_log import Log, no_log

ANDROID = Path(__file__).resolve().parents[3] / "android"
JARS = ("up-core.jar", "virtual-phone.jar")
SOURCES = ("core/src", "virtual/src")
MAIN = "org.raspilot.up.virtual_phone.VirtualPhone"
MAX_BUILD_S = 300.0
QUICK_START = (
    "-Xshare:auto",
    "-XX:TieredStopAtLevel=1",
    "-XX:+UseSerialGC",
    "-XX:-UsePerfData",
    "-Xms16m",
    "-Xmx64m",
)
"""Starts the JVM in a fifth of a second, with one thread of the garbage collector."""
PACKAGE = "default-jdk-headless"


PhoneKind = Literal["auto", "java", "python"]
KINDS = ("auto", "java", "python")
IN_JAVA = "the app's own Up Library, on a Java virtual machine"
IN_PYTHON = "a stub in Python"


class JavaUnavailableError(Exception):
    """The Java phone is unavailable: the message is one sentence for the user."""


@dataclass(frozen=True, slots=True)
class JavaProgram:
    """A JVM and the jars."""

    java: str
    jars: tuple[Path, ...]

    def command(self, *options: str, main: str = MAIN) -> list[str]:
        path = ":".join(map(str, self.jars))
        return [self.java, *QUICK_START, "-cp", path, main, *options]


def find_java_program(log: Log = no_log, android: Path = ANDROID) -> JavaProgram:
    """Return the Java phone, rebuilt if its sources are newer than its jars.

    ``log`` reports in one sentence if outdated jars are used. Raises JavaUnavailableError.
    """
    java = shutil.which("java")
    if java is None:
        raise JavaUnavailableError(f"java is not installed (Debian package {PACKAGE})")
    jars = tuple(android / "build" / name for name in JARS)
    if not _are_fresh(jars, android):
        try:
            _build(android)
        except JavaUnavailableError as error:
            if not all(map(zipfile.is_zipfile, jars)) or not _lacks_tools():
                raise
            text = f"the Java phone is an earlier build, older than its sources: {error}"
            log(text, code="phone_outdated")
    return JavaProgram(java, jars)


@dataclass(frozen=True, slots=True)
class PhoneChoice:
    """The phone aboard; ``title`` names it, and the reason for the choice, to the user."""

    title: str
    java: JavaProgram | None = None


def choose_phone(kind: PhoneKind = "auto", log: Log = no_log) -> PhoneChoice:
    """Return the phone of that kind; auto is the Java one if it is available.

    ``log`` reports a Java phone older than its sources. Raises ParticipantError if Java is required
    but not available.
    """
    if kind == "python":
        return PhoneChoice(IN_PYTHON)
    try:
        return PhoneChoice(IN_JAVA, find_java_program(log))
    except JavaUnavailableError as error:
        if kind == "java":
            raise ParticipantError(f"the Java phone is unavailable: {error}") from error
        return PhoneChoice(f"{IN_PYTHON}: {error}")


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
        raise JavaUnavailableError(f"the sources of the Java phone are missing: {android}")
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
                timeout=MAX_BUILD_S,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            why = f"building the Java phone takes more than {MAX_BUILD_S:g} s"
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
        why = f"cannot write {build}: {error.strerror}"
        raise JavaUnavailableError(why) from error
    with lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _reason(output: str) -> str:
    """Return the most informative line of make's output: the first error, or the last line."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    errors = [line for line in lines if "error:" in line or "needs" in line]
    return (errors or lines[-1:] or ["make printed nothing"])[0]
