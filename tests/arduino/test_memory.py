"""The EEPROM's content on the compiled firmware, and the effects of power cuts."""

import struct

import pytest

from tests.arduino.flight import GAINS_KEPT, Flight

OLD = struct.pack(">18f", *(0.5 * each for each in range(1, 19)))
NEW = struct.pack(">18f", *(0.25 * each for each in range(1, 19)))
NEWEST = struct.pack(">18f", *(0.1 * each for each in range(1, 19)))
PROFILE_VETO = 64


def keep(flight, letter, payload):
    """Send the settings and wait until the EEPROM has stored them."""
    assert flight.ask(letter, payload) == "K"
    flight.run_ms(600)
    assert not flight.rig.eeprom.is_writing


@pytest.fixture(scope="module")
def kept():
    """Return EEPROM with two generations of gains, so that both slots are in use."""
    flight = Flight()
    keep(flight, "g", NEW)
    keep(flight, "g", OLD)
    return flight.rig.eeprom.read()


def boot(eeprom):
    return Flight(eeprom=eeprom, receiver=False)


def test_a_blank_chip_has_the_defaults_and_may_arm():
    flight = Flight()
    assert not flight.status().flags & GAINS_KEPT
    assert not flight.status().vetoes & PROFILE_VETO
    assert flight.rig.eeprom.read() == b"\xff" * 1024


def test_power_cut_at_any_byte_of_a_write_leaves_one_whole_set(kept):
    """The supply sags in the midst of the write of each byte in turn."""
    cuts = 0
    for byte in range(0, 80, 3):
        flight = boot(kept)
        before = flight.rig.eeprom.writes
        flight.send("g", NEWEST)
        for _ in range(3000):
            if flight.rig.eeprom.writes - before > byte and flight.rig.eeprom.is_writing:
                break
            flight.rig.run_us(200)
        else:
            break
        cuts += 1
        flight.rig.brown_out()
        again = boot(flight.rig.eeprom.read())
        assert again.ask("G") in (OLD, NEWEST)
        assert again.status().flags & GAINS_KEPT
    assert cuts > 15


def test_the_same_set_again_writes_no_byte_twice(kept):
    flight = boot(kept)
    keep(flight, "g", OLD)
    first = flight.rig.eeprom.writes
    keep(flight, "g", OLD)
    assert flight.rig.eeprom.writes - first < 90


def test_nothing_is_written_while_armed_and_gains_of_a_flight_are_never_kept():
    flight = Flight()
    flight.run_ms(1500)
    flight.arm()
    assert flight.ask("g", NEW) == "K"
    flight.run_ms(600)
    assert flight.rig.eeprom.writes == 0
    flight.sticks(400, aux2=1000)
    assert not flight.status().is_armed
    flight.run_ms(600)
    assert flight.ask("G") == NEW
    assert flight.rig.eeprom.writes == 0


@pytest.mark.parametrize("kind", ["profile", "gains", "calibration"])
def test_what_was_kept_and_cannot_be_read_forbids_arming(kind):
    flight = Flight()
    flight.run_ms(2000)
    letter, payload = {
        "profile": ("C", flight.ask("c")),
        "gains": ("g", OLD),
        "calibration": ("e", b"\3"),
    }[kind]
    keep(flight, letter, payload)
    spoilt = bytes(value if value == 0xFF else value ^ 0x55 for value in flight.rig.eeprom.read())
    again = Flight(eeprom=spoilt)
    again.run_ms(2000)
    assert again.status().vetoes & PROFILE_VETO
    again.sticks(400, aux2=2000)
    assert not again.status().is_armed
    keep(again, letter, payload)
    assert not again.status().vetoes & PROFILE_VETO
