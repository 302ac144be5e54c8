"""The Java phone for tests: built once, or the running test is skipped."""

from __future__ import annotations

import dataclasses
import functools
import os
import subprocess
from pathlib import Path

import pytest

from tests.support.tools import need_tool
from up_simulator.phone import java_program as build_of_phone
from up_simulator.phone.java_program import ANDROID, JavaUnavailableError, find_java_program

CONSOLE = "org.raspilot.up.virtual_phone.GroundConsole"


@functools.cache
def java_program():
    """Return the Java phone as the simulator finds it, and the ground console beside it.

    Skip or fail without a JDK.

    What does not compile fails, wherever a JDK is.
    """
    need_tool("java", "default-jre-headless")
    need_tool("javac", "default-jdk-headless")
    need_tool("make")
    try:
        program = find_java_program()
    except JavaUnavailableError as error:
        pytest.fail(str(error))
    console = Path("build", "ground-console.jar")
    with build_of_phone._lock(ANDROID / "build"):
        subprocess.run(["make", "-C", ANDROID, console], check=True, stdout=subprocess.DEVNULL)
    return dataclasses.replace(program, jars=(*program.jars, ANDROID / console))


def path_without(folder, *programs):
    """Return a PATH on which everything is that was there, but these programs."""
    folder.mkdir()
    for found in os.environ["PATH"].split(os.pathsep):
        for each in Path(found).glob("*"):
            link = folder / each.name
            if each.name not in programs and not link.is_symlink():
                link.symlink_to(each)
    return str(folder)
