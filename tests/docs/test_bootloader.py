"""The statements of docs/airframe.md about bootloaders hold on the simulated chip."""

from __future__ import annotations

import pytest

from tests.support.firmware import CORE, build_firmware
from tests.support.tools import unavailable
from up_rig import Rig, RigUnavailableError, build_optiboot

CLASSIC = CORE.parents[1] / "bootloaders" / "atmega" / "ATmegaBOOT_168_atmega328.hex"
BOOTED_US = 4_000_000


def rig_with(bootloader):
    """A rig in flight for some seconds under a bootloader."""
    try:
        rig = Rig(build_firmware(), bootloader=bootloader, is_measuring=False)
    except RigUnavailableError as error:
        unavailable(str(error))
    rig.receiver.start()
    rig.run_us(BOOTED_US)
    assert rig.servo.pulses("ailerons")
    return rig


def pulses_after_a_watchdog_reset(rig, duration_us):
    rig.servo.clear()
    rig.force_watchdog_reset()
    rig.run_us(duration_us)
    return rig.servo.pulses("ailerons")


def test_the_classic_bootloader_never_gives_the_servos_back():
    rig = rig_with(CLASSIC)
    assert not pulses_after_a_watchdog_reset(rig, 3_000_000)
    assert rig.measures().resets[3] > 20
    rig.power_on()
    rig.run_us(BOOTED_US)
    assert rig.servo.pulses("ailerons")


@pytest.mark.parametrize("bootloader", ["optiboot", "none"])
def test_optiboot_and_no_bootloader_give_them_back_within_300_ms(bootloader):
    try:
        rig = rig_with(build_optiboot() if bootloader == "optiboot" else None)
    except RigUnavailableError as error:
        unavailable(str(error))
    first, *_ = pulses_after_a_watchdog_reset(rig, 300_000)
    assert first.width_us == 1500
