"""The phone is built from source: the Up Library's tests pass, the app becomes a signed APK."""

from __future__ import annotations

import re

from tests.support.android import BUILD, make, need_android, need_jars
from tests.support.tools import need_tool


def test_the_up_library_passes_its_tests():
    need_jars("junit")
    make("build/core-tests.jar")
    counted = re.search(r"^OK \((\d+) tests\)$", make("test", is_built=True), re.MULTILINE)
    assert counted and int(counted[1]) > 100


def test_the_app_is_built_signed_and_verified():
    need_android()
    said = make()
    for scheme in (1, 2, 3):
        assert re.search(rf"^Verified using v{scheme} scheme .*: true$", said, re.MULTILINE)
    size = re.search(r"^raspilot\.apk (\d+) bytes of 420000 ", said, re.MULTILINE)
    assert size and int(size[1]) == (BUILD / "raspilot.apk").stat().st_size <= 420000


def test_the_help_names_every_target():
    need_tool("make")
    said = make("help")
    for target in ("core", "virtual", "test", "check", "fetch", "clean"):
        assert f"make -C android {target} " in said
