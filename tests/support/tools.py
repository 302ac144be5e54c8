"""What to do where a tool is missing: skip for a developer, fail where everything must run."""

from __future__ import annotations

import os
import shutil
import subprocess

import pytest

from tests.support.virtual_environment import REPOSITORY


def need_tool(name: str, package: str = "") -> str:
    """Return the path of a program; skip the test without it, or fail with UP_REQUIRE_TOOLS."""
    path = shutil.which(name)
    if path is None:
        unavailable(f"{name} is not installed (Debian package {package or name})")
    assert path is not None
    return path


def need_browser() -> str:
    """Return the path of Node; its modules of the browser's tests and Chromium are there, too."""
    node = need_tool("node", "nodejs")
    need_tool("npm")
    need_tool("chromium-headless-shell")
    modules = [REPOSITORY / "tools" / "npm_modules", REPOSITORY / "tests" / "browser"]
    installed = subprocess.run(modules, capture_output=True, text=True, check=False)
    if installed.returncode != 0:
        unavailable(installed.stderr.strip())
    return node


def need_peer(name: str) -> str:
    """Return the path of a program that others wrote, kept beside the repository; skip without."""
    for folder in REPOSITORY.parents[:2]:
        path = folder / "shared" / "peers" / name
        if path.is_file():
            return str(path)
    pytest.skip(f"{name} is not in shared/peers beside the repository")


def unavailable(reason: str) -> None:
    """Skip the running test for a reason of the machine, or fail with UP_REQUIRE_TOOLS set."""
    if os.environ.get("UP_REQUIRE_TOOLS"):
        pytest.fail(f"nothing may be skipped here: {reason}")
    pytest.skip(reason)


def need_root() -> None:
    """Skip the running test where it may not make network namespaces."""
    if os.geteuid() != 0:
        pytest.skip("needs root")
