import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.simulator.scenario.minimal import EXPECT, HEAD
from up.config import ConfigErrors
from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.override import Override
from up_simulator.scenario.scenario import Scenario

TEXT = HEAD + "sticks: [{at_s: 0, mode: FBW}, {at_s: 1, throttle: 0.3}]\n" + EXPECT


def read(*pairs):
    overrides = [Override(f"--set {key}={value}", key, value) for key, value in pairs]
    return parse_scenario(TEXT, "flight.yml", overrides)


def test_values_of_the_file_and_missing_ones_are_set():
    changed = read(
        ("seed", "5"),
        ("duration_s", "9"),
        ("weather.turbulence", "severe"),
        ("sticks.1.throttle", "0.7"),
        ("start", "{roll_deg: 10}"),
    )
    assert (changed.seed, changed.duration_s, changed.weather.turbulence) == (5, 9, "severe")
    assert changed.sticks[1].throttle == 0.7 and changed.start.roll_deg == 10


@pytest.mark.parametrize(
    ("key", "value", "what"),
    [
        ("sed", "5", "--set sed=5: unknown key \"sed\", did you mean 'seed'?"),
        ("seed", "x", "--set seed=x: seed: must be a whole number"),
        ("seed", "", "--set seed=: seed: must have a value"),
        ("sticks.9.throttle", "1", "there is no item '9': the list has 2"),
        ("title.x", "1", "must be"),
        ("seed", "[", "is not valid YAML"),
    ],
)
def test_a_mistake_names_the_option(key, value, what):
    with pytest.raises(ConfigErrors) as caught:
        read((key, value))
    assert what in str(caught.value)


@settings(deadline=None)
@given(st.text(max_size=12), st.text(max_size=12))
def test_any_option_gives_a_scenario_or_mistakes(key, value):
    try:
        assert isinstance(read((key, value)), Scenario)
    except ConfigErrors as errors:
        assert errors.problems
