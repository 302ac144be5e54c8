"""Builds the firmware once for every test process that wants to fly it."""

from __future__ import annotations

import os
from pathlib import Path

from tests.support.tools import unavailable
from up_rig import build

ARDUINO = build.ARDUINO
ROOT = ARDUINO.parent
CORE = build.CORE.parent
BuildError = build.BuildError
make = build.make


def need_toolchain() -> None:
    """Skip the running test without the AVR toolchain, or fail with UP_REQUIRE_TOOLS."""
    lacking = build.missing_toolchain()
    if lacking is not None:
        unavailable(lacking)


def build_firmware(*options: str) -> Path:
    """Return the ELF that ``make -C arduino`` builds; options are for example ``BAUD=9600``.

    ``RASPILOT_ELF`` names another build of the default options to be flown instead.
    """
    if not options and "RASPILOT_ELF" in os.environ:
        return Path(os.environ["RASPILOT_ELF"])
    need_toolchain()
    return build.build_firmware(*options)
