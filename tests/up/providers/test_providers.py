"""Values of providers, their sources and ages, and their form in telemetry."""

import math
import time

import pytest
from twisted.internet.task import Clock

from tests.support.system import build_up
from tests.up.commands.samples import Log
from tests.up.protocols.golden import vectors
from up.commands.altitude_command import AltitudeCommand
from up.commands.command import InvalidCommandError
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.refusal import Code
from up.commands.roles import Role
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.telemetry_schema import FIELDS
from up.providers.base_rx_provider import UpRXProvider
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_heading_provider import UpHeadingProvider
from up.providers.up_location_provider import UpLocationProvider
from up.providers.up_orientation_provider import UpOrientationProvider

BOARD = Origin("arduino", Role.BOARD, 10)
PHONE = Origin("android", Role.SENSOR, 0)
OPERATOR = Origin("ground", Role.OPERATOR, 0)
STICKS = (1500, 1500, 1000, 1500, 2000, 1000)


class Rig:
    """The built-in providers."""

    def __init__(self, folder, **config):
        self.clock = Clock()
        self.up = build_up(
            (), self.clock, folder, config={k + ".yml": v for k, v in config.items()}
        )

    def publish(self, command, origin=BOARD):
        self.up.command_executor.execute_command(command, origin)

    def refusal_of(self, command):
        got = []
        self.up.command_executor.execute_and_wait(command, OPERATOR).addErrback(got.append)
        return got[0].value.code

    def __getitem__(self, cls):
        return self.up.get_module(cls)


@pytest.fixture
def rig(tmp_path):
    return Rig(tmp_path)


def test_a_reading_knows_value_source_time_and_age(rig):
    provider = rig[UpOrientationProvider]
    assert provider.reading is None and provider.fresh(1e9) is None and provider.age_ms is None
    rig.clock.advance(5)
    command = OrientationCommand(1.0, 2.0, 3.0)
    rig.publish(command)
    reading = provider.reading
    assert (reading.value, reading.source, reading.time_s) == (command, "arduino", 5.0)
    rig.clock.advance(0.25)
    assert provider.age_ms == 250
    assert provider.fresh(0.25) is reading
    assert provider.fresh(0.2) is None
    assert provider.roll == 1.0


def test_wall_clock_jumps_are_nothing(rig, monkeypatch):
    rig.publish(OrientationCommand(1.0, 2.0, 3.0))
    now = time.time()
    monkeypatch.setattr(time, "time", lambda: now + 86400)
    assert rig[UpOrientationProvider].fresh(0.001)
    monkeypatch.setattr(time, "time", lambda: now - 86400)
    assert rig[UpOrientationProvider].fresh(0.001)
    assert rig[UpOrientationProvider].age_ms == 0


@pytest.mark.parametrize("place", range(6))
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_an_orientation_that_is_not_finite_is_never_usable(rig, place, bad):
    values = [0.0] * 6
    values[place] = bad
    rig.publish(OrientationCommand(*values, 1))
    assert rig[UpOrientationProvider].fresh(1e9) is None
    rig.publish(OrientationCommand(*[0.0] * 6, 2))
    assert rig[UpOrientationProvider].fresh(0.1)
    rig.publish(OrientationCommand(*values, 3))
    assert rig[UpOrientationProvider].fresh(0.1) is None


def test_one_invalid_channel_makes_the_inputs_unusable(rig):
    for channel in range(6):
        rig.publish(RXCommand(*STICKS, ALL_VALID))
        assert rig[UpRXProvider].fresh(0.1)
        rig.publish(RXCommand(*STICKS, ALL_VALID & ~(1 << channel)))
        assert rig[UpRXProvider].fresh(0.1) is None
        assert rig[UpRXProvider].get_channels()["throttle"] == 1000


def test_invalid_inputs_of_another_source_do_not_replace_good_ones(rig):
    rig.publish(RXCommand(*STICKS, ALL_VALID))
    rig.publish(RXCommand(*STICKS, 0), Origin("other", Role.BOARD, 99))
    assert rig[UpRXProvider].fresh(0.1).source == "arduino"


def test_the_phone_takes_over_from_a_silent_board_and_it_is_logged(rig):
    for _ in range(10):
        rig.publish(OrientationCommand(1, 0, 0))
        rig.publish(OrientationCommand(9, 0, 0), PHONE)
        rig.clock.advance(0.1)
        assert rig[UpOrientationProvider].roll == 1
    with Log() as log:
        for _ in range(10):
            rig.publish(OrientationCommand(9, 0, 0), PHONE)
            rig.clock.advance(0.1)
    assert rig[UpOrientationProvider].reading.source == "android"
    assert [each["source"] for each in log.of("source_switched")] == ["android"]
    with Log() as log:
        for tenth in range(11):
            assert rig[UpOrientationProvider].reading.source == "android", tenth
            rig.publish(OrientationCommand(9, 0, 0), PHONE)
            rig.publish(OrientationCommand(1, 0, 0))
            rig.clock.advance(0.1001)
    assert rig[UpOrientationProvider].reading.source == "arduino"
    assert [each["previous"] for each in log.of("source_switched")] == ["android"]


def test_providers_yml_turns_the_order_round(tmp_path):
    rig = Rig(tmp_path, providers="orientation: [android, arduino]\n")
    rig.publish(OrientationCommand(1, 0, 0))
    for _ in range(12):
        rig.publish(OrientationCommand(9, 0, 0), PHONE)
        rig.publish(OrientationCommand(1, 0, 0))
        rig.clock.advance(0.1)
    assert rig[UpOrientationProvider].reading.source == "android"
    rig.publish(RXCommand(*STICKS, ALL_VALID))
    assert rig[UpRXProvider].reading.source == "arduino"


def test_a_source_that_is_not_listed_comes_after_those_that_are(tmp_path):
    rig = Rig(tmp_path, providers="orientation: [android]\n")
    for _ in range(30):
        rig.publish(OrientationCommand(9, 0, 0), PHONE)
        rig.publish(OrientationCommand(1, 0, 0), Origin("arduino", Role.BOARD, 999))
        rig.clock.advance(0.1)
    assert rig[UpOrientationProvider].reading.source == "android"


def test_heading_measured_and_asked_for(rig):
    provider = rig[UpHeadingProvider]
    heard = []
    provider._on_actual_heading_changed = lambda: heard.append("actual")
    provider._on_required_heading_changed = lambda: heard.append("required")
    rig.publish(HeadingCommand(-90, "actual"), PHONE)
    assert rig.refusal_of(HeadingCommand(360, "required")) is Code.NOT_SUPPORTED
    assert heard == ["actual"]
    assert (provider.actual_heading, provider.required_heading) == (270.0, None)
    assert provider.reading.source == "android"


def test_altitude_measured_and_asked_for(rig):
    provider = rig[UpAltitudeProvider]
    rig.publish(AltitudeCommand(120.5), PHONE)
    assert rig.refusal_of(AltitudeCommand(300, "required")) is Code.NOT_SUPPORTED
    assert (provider.altitude, provider.required_altitude) == (120.5, None)


def test_home_is_the_first_place_and_the_way_back_is_computed_here(rig):
    provider = rig[UpLocationProvider]
    assert provider.distance_from_home is None and provider.required_bearing is None
    rig.publish(LocationCommand(49.0, 16.0, distance_from_home_m=5, required_bearing_deg=5), PHONE)
    rig.publish(LocationCommand(49.001, 16.0, 230.0), PHONE)
    assert provider.distance_from_home == pytest.approx(111.2, abs=0.1)
    assert provider.required_bearing == pytest.approx(180)
    assert (provider.latitude, provider.longitude, provider.altitude) == (49.001, 16.0, 230.0)


def test_a_fix_of_the_vectors_reaches_telemetry_with_age_and_satellites(rig):
    fix = next(each["data"] for each in vectors("general_message.json") if "age_ms" in each["data"])
    rig.publish(LocationCommand.from_data(fix), PHONE)
    value = rig[UpLocationProvider].reading.value
    assert (value.age_ms, value.satellites, value.accuracy_m) == (812.0, 9, 3.1)
    assert {**fix, **value.data} == {**value.data, **fix}
    assert rig.up.telemetry_controller.collect()["location"] == {
        "latitude": 48.1485912, "longitude": 17.1077499, "altitude": 151.3, "satellites": 9,
        "accuracy": 3.1, "fix": None, "pdop": None,
    }  # fmt: skip
    for satellites in (-1, 256, 8.5, True):
        with pytest.raises(InvalidCommandError):
            LocationCommand.from_data({**fix, "satellites": satellites})


def test_telemetry_has_exactly_the_fields_of_the_schema(rig):
    fields = {}
    for each in FIELDS:
        key, _, name = each.path.partition(".")
        fields.setdefault(key, set()).add(name)
    rig.publish(RXCommand(*STICKS, ALL_VALID))
    content = rig.up.telemetry_controller.collect()
    for key in ("orientation", "rates", "rx", "location", "heading"):
        assert set(content[key]) == fields[key], key
    assert "altitude" in fields and content["altitude"] is None
    assert set(content) <= set(fields)
    readings = {"orientation", "rx", "location", "altitude", "heading"}
    assert set(content["age_ms"]) == set(content["source"]) == readings
    assert content["age_ms"]["rx"] == 0 and content["source"]["rx"] == "arduino"
    assert content["age_ms"]["location"] is None and content["source"]["location"] is None


def test_inputs_are_absent_while_no_peer_sends_any(rig):
    content = rig.up.telemetry_controller.collect()
    assert "rx" not in content
    assert content["age_ms"]["rx"] is None


def test_rates_are_null_where_the_source_does_not_know_them(rig):
    rig.publish(OrientationCommand(1, 2, 3, 0.0, None, 4.5))
    content = rig.up.telemetry_controller.collect()
    assert content["orientation"] == {"roll": 1, "pitch": 2, "yaw": 3}
    assert content["rates"] == {"roll": 0.0, "pitch": None, "yaw": 4.5}
