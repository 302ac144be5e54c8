"""The virtual phone for tests: built once, or the running test is skipped."""

from __future__ import annotations

import fcntl
import functools
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.support.tools import need_tool

ANDROID = Path(__file__).parents[2] / "android"
MAIN = "org.raspilot.up.virtual_phone.VirtualPhone"
CONSOLE = "org.raspilot.up.virtual_phone.GroundConsole"
JARS = ("up-core.jar", "virtual-phone.jar")
# Starts the JVM in a fifth of a second, with one thread of the garbage collector.
QUICK_START = (
    "-Xshare:auto",
    "-XX:TieredStopAtLevel=1",
    "-XX:+UseSerialGC",
    "-XX:-UsePerfData",
    "-Xms16m",
    "-Xmx64m",
)


@dataclass(frozen=True, slots=True)
class JavaProgram:
    """A JVM and the jars of the virtual phone and of the ground console."""

    java: str

    def command(self, *options: str, main: str = MAIN) -> list[str]:
        path = ":".join(str(ANDROID / "build" / each) for each in JARS)
        return [self.java, *QUICK_START, "-cp", path, main, *options]


@functools.cache
def java_program():
    """Return the built program. Skip or fail without a JDK; what does not compile fails."""
    java = need_tool("java", "default-jre-headless")
    need_tool("javac", "default-jdk-headless")
    need_tool("make")
    (ANDROID / "build").mkdir(exist_ok=True)
    with (ANDROID / "build" / ".lock").open("w") as lock:
        # One process builds, the others wait for it.
        fcntl.flock(lock, fcntl.LOCK_EX)
        command = ["make", "-C", ANDROID, "virtual"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.fail(done.stdout + done.stderr)
    return JavaProgram(java)


def path_without(folder, *programs):
    """Return a PATH on which everything is that was there, but these programs."""
    folder.mkdir()
    for found in os.environ["PATH"].split(os.pathsep):
        for each in Path(found).glob("*"):
            link = folder / each.name
            if each.name not in programs and not link.is_symlink():
                link.symlink_to(each)
    return str(folder)
