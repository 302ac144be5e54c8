import pytest

from raspilot.navigation.battery_sag import BatterySag


@pytest.fixture
def sag():
    return BatterySag(0.5)


def test_only_a_voltage_under_load_is_a_reference(sag):
    sag.measure(12.6, 0.1)
    assert sag.share == 1.0
    sag.measure(12.0, 0.5)
    assert sag.share == 1.0
    sag.measure(12.6, 0.1)
    assert sag.share == 1.0
    sag.measure(10.8, 0.1)
    assert sag.share == pytest.approx(0.9)


def test_one_false_voltage_changes_little_and_a_broken_divider_is_no_empty_battery(sag):
    for voltage_v in (12.0, 36.0, 11.4):
        sag.measure(voltage_v, 0.5)
    assert sag.share == pytest.approx(0.95, abs=0.002)
    sag.measure(0.5, 0.5)
    assert sag.share == 0.7


def test_another_battery_is_compared_with_itself(sag):
    sag.measure(12.0, 0.5)
    sag.reset()
    sag.measure(7.4, 0.5)
    assert sag.share == 1.0
