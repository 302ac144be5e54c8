"""Runs the Makefile of the phone for tests, one process at a time."""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
from pathlib import Path

from tests.support.tools import need_tool, unavailable

ROOT = Path(__file__).parents[2]
ANDROID = ROOT / "android"
BUILD = ANDROID / "build"
JARS = BUILD / "jars"
LONGEST_S = 600
TOOLS = ("aapt", "zipalign", "apksigner", "dexdump")


class AndroidBuildError(Exception):
    """make fails: the message is what it printed."""


def make(*arguments, folder=ANDROID, env=None):
    """Run make in ``folder`` and return what it printed. Raises ``AndroidBuildError``."""
    need_tool("make")
    BUILD.mkdir(exist_ok=True)
    with (BUILD / ".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = subprocess.run(
            ["make", "--no-print-directory", "-C", str(folder), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=LONGEST_S,
            env={**os.environ, **(env or {})},
        )
    if done.returncode != 0:
        raise AndroidBuildError(done.stdout)
    return done.stdout


def need_jdk():
    """Skip the running test without a JDK, or fail with UP_REQUIRE_TOOLS."""
    need_tool("javac", "default-jdk-headless")


def need_jars(*groups):
    """See to it that groups of jars are here; skip where the network does not bring them."""
    need_jdk()
    need_tool("mvn", "maven")
    try:
        make(*(f"build/jars/.{group}" for group in groups))
    except AndroidBuildError as failure:
        if "Maven could not fetch" in str(failure):
            unavailable(str(failure).strip().splitlines()[0])
        raise


def need_android():
    """Skip the running test where an APK cannot be built, or fail with UP_REQUIRE_TOOLS."""
    for each in TOOLS:
        need_tool(each)
    if not Path("/usr/share/android-framework-res/framework-res.apk").exists():
        unavailable("there is no framework-res.apk (Debian package android-framework-res)")
    need_jars("stubs", "dx", "sniffer", "level-23", "level-26", "level-29")


def lay_out(folder, app):
    """Lay out the build beside the sources of another app; return where to make it."""
    made = folder / "android"
    made.mkdir(parents=True)
    for name in ("Makefile", "pom.xml", "jars.sha256"):
        shutil.copy2(ANDROID / name, made / name)
    shutil.copytree(ANDROID / "tools", made / "tools", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(app, made, dirs_exist_ok=True)
    (folder / "up").mkdir()
    shutil.copy2(ROOT / "up" / "version.py", folder / "up" / "version.py")
    return made
