"""Sensors as sources of readings: faults of the bus, two of a kind, threads."""

import pytest
from sensors_cog.config import SENSORS
from sensors_cog.modules.i2c_sensors import I2cSensors

from tests.cogs.gps_cog.frames import state_at
from up.commands.airspeed_command import AirspeedCommand
from up.commands.altitude_command import AltitudeCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.config import ConfigErrors
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_orientation_provider import UpOrientationProvider
from up.testing import Bench
from up_simulator.sensors.chips import Bmp280, Bmp388, Ms4525do
from up_simulator.sensors.twin import TwinBus

PHONE = Origin("android", Role.SENSOR, 0)
TWO = "sensors: {top: {chip: bmp388}, spare: {chip: bmp280, priority: 10}}\n"


class Rig:
    """The module polled in a test's time, as its thread would."""

    def __init__(self, folder, config, **chips):
        (folder / "sensors.yml").write_text(config)
        self.bench = Bench(
            I2cSensors, UpAltitudeProvider, UpOrientationProvider, config_folder=folder
        )
        self.bus = TwinBus({int(address[1:], 16): chip for address, chip in chips.items()})
        self.sensors = self.bench.module(I2cSensors)
        self.altitude = self.bench.module(UpAltitudeProvider)
        self.opened = []
        self.sensors.open_bus = self._open
        self.sensors.call_in_reactor = lambda call, *given: call(*given)
        self.sensors.on_start()
        self.heard = []
        executor = self.bench.up.command_executor
        executor.adopt_thread()
        for cls in (AltitudeCommand, AirspeedCommand):
            executor.register_command(cls, lambda c: self.heard.append((executor.origin.link, c)))

    def _open(self, number):
        self.opened.append(number)
        return self.bus

    def advance(self, seconds):
        for _ in range(round(seconds / 0.02)):
            self.bench.advance(0.02)
            self.bus.update(state_at(self.bench.clock.seconds()))
            self.sensors.poll()

    @property
    def states(self):
        return {name: each["state"] for name, each in self.telemetry["sensors"].items()}

    @property
    def telemetry(self):
        return self.sensors.telemetry_content


def test_two_of_a_kind_and_the_phone_are_followed_by_their_priority(tmp_path):
    rig = Rig(tmp_path, TWO, x77=Bmp388(), x76=Bmp280())
    top = rig.bus.chips[0x77]
    rig.advance(3.0)
    assert rig.states == {"top": "working", "spare": "working"}
    assert {name for name, _ in rig.heard} == {"top", "spare"}
    assert rig.altitude.reading.source == "top"
    assert rig.altitude.value == pytest.approx(301.5, abs=1.5)
    del rig.bus.chips[0x77]
    rig.advance(3.0)
    assert rig.states["top"] == "absent" and rig.altitude.reading.source == "spare"
    del rig.bus.chips[0x76]
    for _ in range(3):
        rig.bench.up.command_executor.execute_command(AltitudeCommand(300.0), PHONE)
        rig.advance(1.0)
    assert rig.altitude.reading.source == "android"
    # Without power it has forgotten its set-up.
    rig.bus.chips[0x77] = Bmp388()
    assert rig.bus.chips[0x77] is not top
    rig.advance(4.0)
    assert rig.altitude.reading.source == "top" and rig.states["top"] == "working"


def test_errors_of_the_bus_are_counted_and_end_with_it(tmp_path):
    rig = Rig(tmp_path, TWO, x77=Bmp388(), x76=Bmp280())
    rig.advance(2.0)
    turns = iter(range(10**6))
    rig.bus.fails = lambda: next(turns) % 5 == 0
    rig.advance(4.0)
    counters = rig.telemetry["counters"]["sensor_top"]
    assert rig.states["top"] == "working" and counters["bus_errors"] > 3
    assert counters["readings"] > 20
    rig.bus.fails = lambda: True
    rig.advance(2.0)
    assert set(rig.states.values()) == {"absent"}
    rig.bus.fails = lambda: False
    rig.advance(2.0)
    assert set(rig.states.values()) == {"working"}


def test_another_chip_is_named_and_tried_again(tmp_path):
    rig = Rig(tmp_path, "sensors: {top: {chip: bmp388, address: 118}}\n", x76=Bmp280())
    rig.advance(2.0)
    assert rig.states == {"top": "wrong_chip"} and not rig.heard
    rig.bus.chips[0x76] = Bmp388()
    rig.advance(2.0)
    assert rig.states == {"top": "working"}


def test_a_sensor_that_raises_does_not_keep_the_others_from_working(tmp_path, monkeypatch):
    rig = Rig(tmp_path, TWO, x77=Bmp388(), x76=Bmp280())
    rig.advance(2)
    rig.heard.clear()

    def fail(sensor, aircraft):
        raise ZeroDivisionError

    monkeypatch.setattr("sensors_cog.chips.barometers.Bmp388.read", fail)
    rig.advance(2)
    assert rig.states == {"top": "failed", "spare": "working"}
    assert len([link for link, _ in rig.heard if link == "spare"]) > 15
    assert rig.telemetry["counters"]["sensor_top"]["faults"] == 1


def test_a_missing_bus_is_tried_again(tmp_path):
    rig = Rig(tmp_path, TWO, x77=Bmp388())

    def missing(number):
        raise FileNotFoundError(2, "No such file or directory")

    rig.sensors.open_bus, found = missing, rig.sensors.open_bus
    rig.advance(2.0)
    assert rig.states == {"top": "absent", "spare": "absent"}
    rig.sensors.open_bus = found
    rig.advance(2.0)
    assert rig.states == {"top": "working", "spare": "absent"} and rig.opened == [1]


def test_an_airspeed_is_published(tmp_path):
    rig = Rig(tmp_path, "sensors: {pitot: {chip: ms4525do}}\n", x28=Ms4525do())
    rig.advance(2.0)
    name, command = rig.heard[-1]
    assert name == "pitot" and command.airspeed_m_s == pytest.approx(12.0, abs=0.6)


def test_the_bus_is_read_on_a_thread_and_closed_at_the_end(tmp_path):
    (tmp_path / "sensors.yml").write_text("sensors: {pitot: {chip: ms4525do}}\n")
    bench = Bench(I2cSensors, UpAltitudeProvider, UpOrientationProvider, config_folder=tmp_path)
    bus = TwinBus({0x28: Ms4525do()})
    bus.update(state_at(1.0))
    bench.module(I2cSensors).open_bus = lambda number: bus
    bench.start()
    try:
        # The thread reports that the sensor works.
        bench.clock.take_call()
        assert bench.module(I2cSensors).telemetry_content["sensors"]["pitot"]["state"] == "working"
    finally:
        bench.stop()
    assert not bus.is_open


@pytest.mark.parametrize(
    "text", ["sensors: {Top: {}}\n", "sensors: {a: {chip: bmp999}}\n", "sensors: {a: {bus: -1}}\n"]
)
def test_what_cannot_be_meant_is_refused(text):
    with pytest.raises(ConfigErrors):
        SENSORS.parse(text, SENSORS.filename)
