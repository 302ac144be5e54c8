"""The Java phone for tests: built once, or the running test is skipped."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.support.tools import need_tool
from up_simulator.java_phone_program import JavaUnavailableError, find_java_program


def java_program():
    """Return the Java phone as the simulator finds it; skip or fail without a JDK.

    What does not compile fails, wherever a JDK is.
    """
    need_tool("java", "default-jre-headless")
    need_tool("javac", "default-jdk-headless")
    need_tool("make")
    try:
        return find_java_program()
    except JavaUnavailableError as error:
        pytest.fail(str(error))


def path_without(folder, *programs):
    """Return a PATH on which everything is that was there, but these programs."""
    folder.mkdir()
    for found in os.environ["PATH"].split(os.pathsep):
        for each in Path(found).glob("*"):
            link = folder / each.name
            if each.name not in programs and not link.is_symlink():
                link.symlink_to(each)
    return str(folder)
