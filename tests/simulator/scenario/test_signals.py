import dataclasses

import pytest

from up_simulator.aircraft.flight import FlightState
from up_simulator.scenario.signals import SIGNALS, Kind, signal_of


def test_every_field_of_the_true_state_is_a_signal():
    fields = {field.name for field in dataclasses.fields(FlightState)} - {"time_s"}
    truth = {name.partition(".")[2] for name in SIGNALS if name.startswith("truth.")}
    assert truth == fields | {"crashed"}


def test_names_end_with_their_unit():
    units = {"deg": "_deg", "m": "_m", "us": "_us", "ms": "_ms", "s": "_s", "g": "_g"}
    for signal in SIGNALS.values():
        if signal.unit in units and signal.source != "ground":
            assert signal.name.endswith(units[signal.unit]), signal.name


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("truth.rol_deg", "truth.roll_deg"),
        ("Board.Mode", "board.mode"),
        ("ground.orientation.rol", "ground.orientation.roll"),
        ("servo.stale", "servo.stale_ms"),
        ("pitch_deg", "truth.pitch_deg"),
    ],
)
def test_an_unknown_name_gets_a_suggestion(name, near):
    with pytest.raises(KeyError) as caught:
        signal_of(name)
    assert f"'{near}'" in caught.value.args[0]


def test_an_unknown_name_without_a_match_refers_to_the_list():
    with pytest.raises(KeyError, match="up-sim signals"):
        signal_of("xyzzy")


def test_counters_of_modules_are_signals():
    assert signal_of("ground.counters.serial.dropped").kind is Kind.NUMBER
    for wrong in ("ground.counters", "ground.counters.", "ground.counters.a"):
        with pytest.raises(KeyError):
            signal_of(wrong)
