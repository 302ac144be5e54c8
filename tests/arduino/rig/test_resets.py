"""Resets: their causes, what outlives them, and time, which never stops."""

import pytest

from tests.arduino.rig.firmware import build, make_rig
from tests.support.tools import unavailable
from up_rig import FirmwareError, Reset, RigUnavailableError, build_optiboot
from up_rig.pins import pin

LED = pin("D13")
START_UP_US = 66_000
KEPT = bytes([0x11, 0x22, 0x33, 0x44])
BOOT_US = 3_000
"""More than the program takes to say its six bytes."""


@pytest.fixture
def case(tmp_path):
    def make(number, **options):
        return make_rig(build("resets", tmp_path, f"-DCASE={number}"), **options)

    return make


@pytest.fixture
def optiboot():
    try:
        return build_optiboot()
    except RigUnavailableError as error:
        unavailable(str(error))


def boots(said):
    """Return (cause, kept bytes) of every start."""
    return [(said[at], said[at + 1 : at + 5]) for at in range(0, len(said) - 5, 6)]


def test_power_on_starts_after_the_fuses_time_with_random_ram(case):
    rig = case(1)
    rig.run_us(START_UP_US)
    assert rig.serial.read() == b""
    rig.run_us(BOOT_US)
    ((cause, kept),) = boots(rig.serial.read())
    assert cause == Reset.POWER_ON
    assert kept != KEPT and kept != bytes(4)
    other = case(1, seed=2)
    other.run_us(START_UP_US + BOOT_US)
    assert boots(other.serial.read())[0][1] != kept


def test_the_watchdog_resets_and_time_goes_on(case):
    rig = case(1)
    rig.receiver.start()
    rig.run_us(START_UP_US + BOOT_US)
    rig.serial.read()
    rig.run_us(128_000 + START_UP_US)
    assert boots(rig.serial.read()) == [(Reset.WATCHDOG, KEPT)]
    assert rig.now_us == pytest.approx(2 * START_UP_US + BOOT_US + 128_000, abs=1)
    assert rig.measures().resets == (1, 0, 0, 1)
    frames = [pulse for pulse in rig.receiver.sent if pulse.channel == "aux1"]
    assert len(frames) == int(rig.now_us / 20_000) + 1


def test_the_wires_move_while_the_chip_is_in_reset(case):
    rig = case(1)
    rig.receiver.start(at_us=0)
    rig.run_us(START_UP_US + BOOT_US)
    rig.press_reset()
    rig.run_us(START_UP_US / 2)
    levels = set()
    for _ in range(50):
        rig.run_us(500)
        levels.add(rig.receiver.level("rudder"))
    assert rig.serial.read()[6:] == b""
    assert levels == {0, 1}


def test_a_fed_watchdog_does_not_reset(case):
    rig = case(2)
    rig.run_us(START_UP_US + 505_000)
    assert rig.measures().resets == (1, 0, 0, 0)
    assert len(rig.servo.pin_edges(LED)) == 1
    rig.run_us(128_000)
    assert rig.measures().resets == (1, 0, 0, 1)
    # A reset lets go of every pin.
    assert [level for _cycle, level in rig.servo.pin_edges(LED)] == [1, 0]


def test_a_slow_oscillator_makes_the_watchdog_late(case):
    rig = case(1)
    rig.set_watchdog_factor(1.1)
    rig.run_us(START_UP_US + 128_000 + 8_000)
    assert rig.measures().resets[3] == 0
    rig.run_us(8_000)
    assert rig.measures().resets[3] == 1


def test_the_watchdog_interrupts(case):
    rig = case(3)
    rig.run_us(START_UP_US + 1000 + 16_000 * 4)
    assert rig.measures().interrupts["WDT"] == 4
    assert rig.measures().resets == (1, 0, 0, 0)


@pytest.mark.parametrize(
    "name, cause",
    [("press_reset", Reset.EXTERNAL), ("brown_out", Reset.BROWN_OUT)],
)
def test_the_other_causes_are_distinguished(case, name, cause):
    rig = case(5)
    rig.run_us(START_UP_US + BOOT_US)
    rig.serial.read()
    getattr(rig, name)()
    rig.run_us(START_UP_US + BOOT_US)
    said = rig.serial.read()
    assert (said[0], said[1:5]) == (cause, KEPT)


def test_a_long_brown_out_loses_the_ram(case):
    rig = case(5)
    rig.run_us(START_UP_US + BOOT_US)
    rig.serial.read()
    rig.brown_out(keeps_ram=False)
    rig.run_us(START_UP_US + BOOT_US)
    assert rig.serial.read()[1:5] != KEPT


def test_optiboot_runs_before_the_program(case, optiboot):
    rig = case(1, bootloader=optiboot)
    rig.run_us(START_UP_US + BOOT_US)
    assert rig.serial.read()[-1:] == b"\xee"
    rig.run_us(128_000 + START_UP_US)
    ((_cause, kept),) = boots(rig.serial.read())
    # Its stack may lie over the program's variables, but it keeps to the top of the RAM.
    assert kept == KEPT


def test_optiboot_waits_for_a_programmer_after_the_reset_pin(case, optiboot):
    rig = case(5, bootloader=optiboot)
    rig.run_us(START_UP_US + BOOT_US)
    rig.press_reset()
    rig.run_us(START_UP_US)
    rig.serial.read()
    rig.run_us(400_000)
    assert rig.serial.read() == b""
    assert rig.servo.pin_edges(LED), "it blinks"
    rig.run_us(2_000_000)
    assert b"\xee" in rig.serial.read()


def test_a_variable_can_be_set_before_the_program_begins(case):
    rig = case(5)
    rig.preload("counter", b"\xfe")
    rig.run_us(START_UP_US + 10_000)
    said = rig.serial.read()
    assert said[said.index(0xEE) + 1 :][:3] == b"\xfe\xff\x00"


@pytest.mark.parametrize(
    ("name", "value", "code"),
    [("missing", b"\0", "no_symbol"), ("counter", b"\0\0", "not_a_variable")],
)
def test_only_a_variable_that_fits_can_be_preloaded(case, name, value, code):
    with pytest.raises(FirmwareError, match=name) as caught:
        case(5).preload(name, value)
    assert caught.value.code == code


def test_a_write_of_the_eeprom_takes_its_time(case):
    rig = case(6, eeprom=bytes(range(16)))
    rig.run_us(START_UP_US + 10_000)
    said = rig.serial.read()[6:]
    assert said[:2] == bytes([10, 2])
    assert int.from_bytes(said[2:4], "big") / 2 == pytest.approx(3400, abs=20)
    assert said[4:] == b"\x5a\xee"
    assert rig.eeprom.read(8, 4) == bytes([8, 9, 0x5A, 11])
    assert rig.eeprom.writes == 1


def run_to_the_write(rig):
    rig.run_us(START_UP_US)
    while not rig.eeprom.is_writing:
        rig.run_us(10)


@pytest.mark.parametrize("cut_us", [0, 500, 1700, 2500, 3300])
def test_power_that_fails_in_a_write_spoils_one_byte(case, cut_us):
    rig = case(6, eeprom=bytes(16))
    run_to_the_write(rig)
    rig.run_us(cut_us)
    assert rig.eeprom.is_writing
    rig.power_on()
    assert not rig.eeprom.is_writing
    held = rig.eeprom.read(0, 16)
    assert held[:10] + held[11:] == bytes(15)
    assert rig.eeprom.writes == 0


def test_an_erased_cell_may_be_half_written(case):
    values = set()
    for seed in range(1, 12):
        rig = case(6, eeprom=bytes(16), seed=seed)
        run_to_the_write(rig)
        rig.run_us(2500)
        rig.power_on()
        values.add(rig.eeprom.read(10, 1)[0])
    assert len(values) > 3
    assert all(value & 0x5A == 0x5A for value in values), "bits that stay are not cleared"


def test_a_reset_lets_a_write_end(case):
    rig = case(6, eeprom=bytes(16))
    run_to_the_write(rig)
    rig.press_reset()
    rig.run_us(5_000)
    assert rig.eeprom.read(10, 1) == b"\x5a"


def test_the_eeprom_guards_its_writes(case):
    rig = case(7, eeprom=bytes(16))
    rig.run_us(START_UP_US + 10_000)
    assert rig.serial.read()[6:] == bytes([0, 0, 0xFF, 0xEE])


def test_the_stacks_depth_is_seen_two_ways(case):
    rig = case(8)
    rig.power_on(ram=b"\xc5")
    rig.run_us(START_UP_US + 10_000)
    assert 500 < rig.measures().stack_bytes < 530
    assert 2048 - 530 - 16 < rig.untouched_ram() < 2048 - 500


def test_two_rigs_run_alike(case):
    def live():
        rig = case(2, seed=7)
        rig.receiver.jitter_us = 3.0
        rig.receiver.start(at_us=1000)
        rig.run_us(START_UP_US + 200_000)
        return rig.serial.read_stamped(), rig.servo.pin_edges(LED), rig.receiver.sent

    assert live() == live()
