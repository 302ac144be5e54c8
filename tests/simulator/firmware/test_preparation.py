"""An airframe's settings reach the board as from the Pi, or the reason is reported."""

import math
import pickle
import struct

import pytest

from tests.support.firmware import build_firmware
from tests.support.tools import unavailable
from up_simulator.firmware import preparation
from up_simulator.firmware.build import BoardUnavailableError, aboard
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import (
    PreparationError,
    SettingsError,
    cached_eeprom,
    gains_bytes,
    prepare_eeprom,
    profile_bytes,
)
from up_simulator.firmware.rig_board import RigBoard

CHANNEL = (0, 0, 1000, 2000)
GAINS = tuple(float(each) for each in range(18))
HELD = struct.pack(
    ">" + "BhHH" * 4 + "2B3s5h5HB",
    *(*CHANNEL * 4, 0, 1, b"afA", 5000, 2000, 2500, -300, 2000, 1000, 900, 1500, 1500, 1500, 0),
)
HELD_GAINS = struct.pack(">18f", *GAINS)
PROFILE = {
    "ailerons": {"reversed": True, "trim_us": -12, "lowest_us": 950, "highest_us": None},
    "mix": "elevon",
    "motor": False,
    "switch": {"low": "FBW", "high": None},
    "fly_by_wire": {"roll_deg": 45.5},
    "receiver_lost": {"below_us": 880, "circle_bank_deg": -15, "return_with_motor": True},
}
GAINS_SET = {
    "units": "degrees per second",
    "rate": {"ailerons": {"p": 2.5, "i": 0.25}},
    "stabilize": {"elevator": {"p": 3.5}},
}


@pytest.fixture(scope="module")
def elf():
    return build_firmware()


def board(elf, **options):
    return RigBoard(elf, imu_errors=ImuErrors(), **options)


def asked(aboard_now, letter):
    tap = LineMonitor()
    aboard_now.write(tap.command_bytes(letter))
    aboard_now.run_us(60_000)
    tap.feed(aboard_now.read(), 0.0)
    return tap.take_answers()[-1].payload


def test_named_settings_change_their_fields_and_no_others():
    wire = profile_bytes(PROFILE, HELD)
    assert wire[:7] == struct.pack(">BhHH", 1, -12, 950, 2000)
    assert wire[7:28] == HELD[7:28]
    assert wire[28:33] == b"\1\0ffA"
    assert wire[33:43] == struct.pack(">3h2h", 4550, 2000, 2500, -300, -1500)
    assert wire[43:] == struct.pack(">2H3HB", 1000, 880, 1500, 1500, 1500, 1)
    assert profile_bytes({}, HELD) == HELD


def test_named_gains_change_their_places_and_no_others():
    values = list(struct.unpack(">18f", gains_bytes(GAINS_SET, HELD_GAINS)))
    assert (values[0], values[1], values[12]) == (2.5, 0.25, 3.5)
    values[0], values[1], values[12] = GAINS[0], GAINS[1], GAINS[12]
    assert tuple(values) == GAINS


@pytest.mark.parametrize(
    ("make", "settings", "code", "key"),
    [
        (profile_bytes, {"flaps": 1}, "unknown_profile_key", "flaps"),
        (profile_bytes, {"ailerons": {"trim": 1}}, "unknown_profile_key", "ailerons.trim"),
        (profile_bytes, {"mix": "delta"}, "invalid_profile", "mix"),
        (profile_bytes, {"rudder": {"trim_us": "much"}}, "invalid_profile", ""),
        (profile_bytes, {"rudder": {"trim_us": 201}}, "invalid_profile", "rudder.trim_us"),
        (gains_bytes, {"rate": {"flaps": {"p": 1}}}, "unknown_gain", "rate.flaps.p"),
        (gains_bytes, {"rate": {"ailerons": {"q": 1}}}, "unknown_gain", "rate.ailerons.q"),
        (gains_bytes, {"rate": {"ailerons": {"p": 50.5}}}, "gain_out_of_range", "rate.ailerons.p"),
        (gains_bytes, {"rate": {"ailerons": {"p": math.nan}}}, "gain_out_of_range", "nan"),
    ],
)
def test_invalid_settings_are_refused(make, settings, code, key):
    with pytest.raises(SettingsError) as error:
        make(settings, HELD if make is profile_bytes else HELD_GAINS)
    assert (error.value.code, key in str(error.value)) == (code, True)


def test_an_error_of_settings_is_the_same_after_a_copy_between_processes():
    error = pickle.loads(pickle.dumps(SettingsError("a text", "unknown_gain")))
    assert (str(error), error.code) == ("a text", "unknown_gain")


def test_a_board_with_the_prepared_eeprom_boots_with_the_settings(elf):
    prepared = prepare_eeprom(board(elf), PROFILE, GAINS_SET)
    fresh = board(elf, eeprom=prepared)
    fresh.run_us(1_500_000)
    assert asked(fresh, "c") == profile_bytes(PROFILE, HELD)
    values = struct.unpack(">18f", asked(fresh, "G"))
    assert (values[0], values[1], values[12]) == (2.5, 0.25, 3.5)


@pytest.mark.parametrize("divider", [0.0, 0.08])
def test_a_divider_is_calibrated_also_without_a_motor(elf, divider):
    prepared = prepare_eeprom(board(elf), {"motor": False}, {}, divider)
    fresh, tap = board(elf, eeprom=prepared), LineMonitor()
    fresh.set_a7(11.1 * 0.08)
    fresh.run_us(1_500_000)
    fresh.write(tap.start_bytes())
    fresh.run_us(300_000)
    tap.feed(fresh.read(), 1.8)
    assert tap.status.battery_mv == pytest.approx(11_100 if divider else 0, abs=30)


def test_the_work_is_done_once_for_each_firmware_and_each_set(tmp_path, monkeypatch, elf):
    monkeypatch.setattr(preparation, "cache_path", lambda *names: tmp_path.joinpath(*names))
    made = []

    def counted(*arguments):
        made.append(arguments)
        return prepare_eeprom(*arguments)

    monkeypatch.setattr(preparation, "prepare_eeprom", counted)
    try:
        first = cached_eeprom("firmware", {"motor": False}, {})
    except BoardUnavailableError as error:
        unavailable(str(error))
    assert cached_eeprom("firmware", {"motor": False}, {}) == first
    assert len(made) == 1
    assert cached_eeprom("firmware", {"motor": True}, {}) != first
    assert len(made) == 2


def test_no_flight_computer_needs_no_eeprom():
    assert cached_eeprom("direct", {}, {}) == b""


def test_a_refusal_names_setting_and_reason(elf):
    armed = board(elf)
    armed.set_stick("aux2", 1000)
    armed.run_us(2_000_000)
    armed.set_stick("aux2", 2000)
    armed.run_us(500_000)
    with pytest.raises(PreparationError) as caught:
        prepare_eeprom(armed, {"motor": False}, {})
    assert caught.value.code == "refused"


def test_a_board_without_an_answer_is_reported():
    silent = aboard("firmware").board()
    silent.write = lambda _data: None
    with pytest.raises(PreparationError) as caught:
        prepare_eeprom(silent, {}, {})
    assert caught.value.code == "no_answer"
