"""The sensor of docs/how-to/sensor.md: its own test, and its flight beside the phone."""

import importlib
import sys

import pytest

from tests.cogs.sensors_cog.test_i2c_sensors import Rig
from tests.docs.test_how_to import examples
from tests.support.application import importable

PAGE = "sensor.md"
MAX_LINES = 30


@pytest.fixture
def files(tmp_path):
    """Write the page's files and let them be imported."""
    found = examples(PAGE)
    for name, text in found.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    with importable(tmp_path, "my_sensors"):
        yield found


def test_the_sensor_and_its_twin_are_short(files):
    for name in ("my_sensors/lps22.py", "my_sensors/lps22_twin.py"):
        assert len(files[name].splitlines()) <= MAX_LINES


def test_the_test_of_the_page_holds_and_can_fail(files):
    importlib.import_module("my_sensors.test_lps22").test_it_measures_the_altitude()
    sys.modules["my_sensors.lps22"].COUNTS_PER_HPA = 4000
    with pytest.raises(AssertionError):
        sys.modules["my_sensors.test_lps22"].test_it_measures_the_altitude()


def test_the_configuration_of_the_page_makes_it_the_source_of_the_altitude(files, tmp_path):
    twin = importlib.import_module("my_sensors.lps22_twin").Lps22Twin()
    rig = Rig(tmp_path, files["config/sensors.yml"], x5C=twin)
    rig.advance(3.0)
    assert rig.states == {"height": "working"}
    assert rig.altitude.reading.source == "height"
    assert rig.altitude.value == pytest.approx(301.5, abs=1.0)
    rig.bus.chips.clear()
    rig.advance(2.0)
    assert rig.states == {"height": "absent"}
