"""Runs the Makefile of the phone for tests."""

from __future__ import annotations

import fcntl
import os
import shutil
import signal
import subprocess
from contextlib import nullcontext
from pathlib import Path

from tests.support.tools import need_tool, unavailable

ROOT = Path(__file__).parents[2]
ANDROID = ROOT / "android"
BUILD = ANDROID / "build"
JARS = BUILD / "jars"
LONGEST_S = 600
# 700 MB by a slow network.
LONGEST_FETCH_S = 1500
TOOLS = ("aapt", "zipalign", "apksigner", "dexdump")
# What `make test TEST=...` hands down is not meant for the phone's Makefile.
FROM_ABOVE = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "MAKEOVERRIDES", "TEST")


class AndroidBuildError(Exception):
    """make fails: the message is its output."""


class AndroidBuildLateError(AndroidBuildError):
    """make was ended: the message has the time limit and the output."""


def make(*arguments, folder=ANDROID, env=None, is_built=False, limit_s=LONGEST_S):
    """Run make in ``folder`` and return what it printed. Raises ``AndroidBuildError``.

    One process at a time builds in the project's own folder; a target that ``is_built`` only runs
    there, without the lock.
    """
    need_tool("make")
    BUILD.mkdir(exist_ok=True)
    builds_here = Path(folder) == ANDROID and not is_built
    with (BUILD / ".lock").open("w") if builds_here else nullcontext() as lock:
        if lock is not None:
            fcntl.flock(lock, fcntl.LOCK_EX)
        return _run(["make", "--no-print-directory", "-C", str(folder), *arguments], env, limit_s)


def _run(command, env, limit_s):
    handed = {name: value for name, value in os.environ.items() if name not in FROM_ABOVE}
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**handed, **(env or {})},
        start_new_session=True,
    ) as running:
        try:
            said, _ = running.communicate(timeout=limit_s)
        except subprocess.TimeoutExpired:
            # Make alone would leave its child processes behind.
            os.killpg(running.pid, signal.SIGKILL)
            said, _ = running.communicate()
            late = f"{' '.join(command)} was ended after {limit_s} s\n{said}"
            raise AndroidBuildLateError(late) from None
        except BaseException:
            os.killpg(running.pid, signal.SIGKILL)
            raise
    if running.returncode != 0:
        raise AndroidBuildError(said)
    return said


def need_jdk():
    """Skip the running test without a JDK, or fail with UP_REQUIRE_TOOLS."""
    need_tool("javac", "default-jdk-headless")


def need_jars(*groups):
    """See to it that groups of jars are here; skip where the network does not bring them."""
    need_jdk()
    need_tool("mvn", "maven")
    try:
        make(*(f"build/jars/.{group}" for group in groups), limit_s=LONGEST_FETCH_S)
    except AndroidBuildLateError:
        unavailable(f"the network did not bring the jars within {LONGEST_FETCH_S / 60:g} min")
    except AndroidBuildError as failure:
        if "fetch_failed" in str(failure):
            unavailable(str(failure).strip().splitlines()[0])
        raise


def need_android():
    """Skip the running test where an APK cannot be built, or fail with UP_REQUIRE_TOOLS."""
    for each in TOOLS:
        need_tool(each)
    if not Path("/usr/share/android-framework-res/framework-res.apk").exists():
        unavailable("there is no framework-res.apk (Debian package android-framework-res)")
    need_jars("stubs", "framework", "dx", "proguard", "sniffer", "level-23", "level-26")


def lay_out(folder, app):
    """Lay out the build beside the sources of another app; return where to make it."""
    made = folder / "android"
    made.mkdir(parents=True)
    for name in ("Makefile", "jars.list"):
        shutil.copy2(ANDROID / name, made / name)
    shutil.copytree(ANDROID / "tools", made / "tools", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(app, made, dirs_exist_ok=True)
    (folder / "up").mkdir()
    shutil.copy2(ROOT / "up" / "version.py", folder / "up" / "version.py")
    return made
