"""The chips beside their twins, and both beside the data sheets."""

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sensors_cog.chips.airspeed import crc8
from sensors_cog.chips.barometers import Bmp280, Bmp388
from sensors_cog.config import CHIPS, SensorConfig
from sensors_cog.modules.i2c_sensors import class_of
from sensors_cog.sensor import Aircraft, WrongChipError

from tests.cogs.gps_cog.frames import state_at
from up_simulator.sensors import chips as twins
from up_simulator.sensors.chips import bus_of
from up_simulator.sensors.twin import RegisterChip

BAROMETERS, AIRSPEEDS = ("bmp280", "bmp388"), ("ms4525do", "sdp3x")
POWER, COMPASSES = ("ina219", "ina226"), ("qmc5883l", "ist8310")


def begun(chip, **config):
    """Return a chip that is set up at its twin, and the bus."""
    bus = bus_of([chip], 1)
    sensor = class_of(chip)(bus, SensorConfig(chip=chip, **config))
    sensor.begin()
    return sensor, bus


def measured(chip, state, aircraft=None, **config):
    sensor, bus = begun(chip, **config)
    bus.update(state)
    return sensor.read(aircraft or Aircraft(state.roll_deg, state.pitch_deg, state.altitude_m))


def flying(**changes):
    return dataclasses.replace(state_at(3.0), battery_v=11.4, motor_w=80.0, **changes)


def test_the_bmp280_computes_the_example_of_its_data_sheet():
    sensor, bus = begun("bmp280")
    assert sensor.pressure_pa(415148, 519888) == pytest.approx(100653.27, abs=0.01)
    twin = bus.chips[0x76]
    assert twin.compensated_pa(415148, 519888) == pytest.approx(100653.27, abs=0.1)
    assert (twin.registers[0xF4], twin.registers[0xF5]) == (0x57, 0x08)


@given(st.integers(280_000, 600_000), st.integers(450_000, 560_000))
def test_the_two_arithmetics_of_the_bmp280_agree(raw_p, raw_t):
    sensor, bus = begun("bmp280")
    expected = bus.chips[0x76].compensated_pa(raw_p, raw_t)
    assert sensor.pressure_pa(raw_p, raw_t) == pytest.approx(expected, abs=0.5)


@given(st.integers(4_000_000, 10_000_000), st.integers(7_500_000, 9_000_000))
def test_the_two_arithmetics_of_the_bmp388_agree(raw_p, raw_t):
    sensor, bus = begun("bmp388")
    expected = bus.chips[0x77].compensated_pa(raw_p, raw_t)
    assert sensor.pressure_pa(raw_p, raw_t) == pytest.approx(expected, abs=1e-3)


@given(st.binary(min_size=24, max_size=24), st.binary(min_size=6, max_size=6))
def test_any_calibration_and_any_data_give_an_altitude_or_none(calibration, data):
    for cls, at, place, status in ((Bmp280, 0x88, 0xF7, None), (Bmp388, 0x31, 0x04, 0x03)):
        chip = RegisterChip()
        chip.put(0xD0, [0x58])
        chip.put(0x00, [0x50])
        chip.put(at, calibration)
        chip.put(place, data)
        if status:
            chip.put(status, [0x60])
        sensor = cls(twins.TwinBus({cls.ADDRESS: chip}), SensorConfig())
        sensor.begin()
        found = sensor.read(Aircraft())
        assert found is None or -2000 < found.altitude_m < 10_000


@pytest.mark.parametrize("chip", BAROMETERS)
@pytest.mark.parametrize("altitude_m", [-200.0, 0.0, 301.5, 3000.0])
def test_a_barometer_measures_the_altitude(chip, altitude_m):
    found = measured(chip, flying(altitude_m=altitude_m))
    assert found.altitude_m == pytest.approx(altitude_m, abs=1.0)


def test_the_checksum_of_the_sdp3x_is_that_of_its_data_sheet():
    assert crc8(b"\xbe\xef") == 0x92 == twins._crc(b"\xbe\xef")


@pytest.mark.parametrize("chip", AIRSPEEDS)
@pytest.mark.parametrize("altitude_m", [0.0, 1500.0])
def test_an_airspeed_is_true_at_any_altitude(chip, altitude_m):
    found = measured(chip, flying(airspeed_m_s=14.0, altitude_m=altitude_m))
    assert found.airspeed_m_s == pytest.approx(14.0, abs=0.4)
    still = measured(chip, flying(airspeed_m_s=0.0), offset_pa=20.0)
    assert still.airspeed_m_s == 0.0 and abs(still.pressure_pa) < 6.0


def test_a_stale_count_of_the_ms4525do_is_no_measurement():
    sensor, bus = begun("ms4525do")
    bus.update(flying())
    assert sensor.read(Aircraft()) is not None
    assert sensor.read(Aircraft()) is None
    # By the transfer function of type A: half of the counts are 0 psi.
    bus.chips[0x28].registers[:2] = round(0.5 * 16383).to_bytes(2)
    assert sensor.read(Aircraft()).pressure_pa == pytest.approx(0.0, abs=1.0)
    bus.chips[0x28].registers[:2] = round(0.9 * 16383).to_bytes(2)
    assert sensor.read(Aircraft()).pressure_pa == pytest.approx(6894.757, abs=1.0)


def test_a_wrong_checksum_of_the_sdp3x_is_no_measurement():
    sensor, bus = begun("sdp3x")
    bus.update(flying())
    twin, read = bus.chips[0x21], bus.chips[0x21].read
    twin.read = lambda count: bytes([read(count)[0] ^ 1, *read(count)[1:]])
    assert sensor.read(Aircraft()) is None
    twin.read = read
    assert sensor.read(Aircraft()) is not None


def test_a_running_measurement_of_the_sdp3x_is_begun_again():
    sensor, bus = begun("sdp3x")
    bus.update(flying())
    sensor.begin()
    bus.update(flying(airspeed_m_s=10.0))
    assert sensor.read(Aircraft()).airspeed_m_s == pytest.approx(10.0, abs=0.2)


@pytest.mark.parametrize("chip", POWER)
def test_a_power_monitor_measures_voltage_and_current(chip):
    found = measured(chip, flying(), shunt_mohm=1.0)
    assert found.voltage_v == pytest.approx(11.4, abs=0.004)
    assert found.current_a == pytest.approx(80 / 11.4, abs=0.011)
    sensor, bus = begun(chip, shunt_mohm=1.0)
    bus.chips[0x40].words[0x01] = 0xFFFF
    assert sensor.read(Aircraft()).current_a < 0.0


@pytest.mark.parametrize("chip", COMPASSES)
@pytest.mark.parametrize(("roll", "pitch"), [(0.0, 0.0), (35.0, -10.0), (-20.0, 15.0)])
@pytest.mark.parametrize("yaw", [0.0, 90.0, 200.0, 355.0])
def test_a_compass_measures_the_heading_in_any_attitude(chip, roll, pitch, yaw):
    state = flying(roll_deg=roll, pitch_deg=pitch, yaw_deg=yaw)
    found = measured(chip, state)
    assert math.remainder(found.heading_deg - yaw, 360.0) == pytest.approx(0.0, abs=3.0)
    turned = measured(chip, state, declination_deg=4.0)
    assert math.remainder(turned.heading_deg - yaw - 4.0, 360.0) == pytest.approx(0.0, abs=3.0)


def test_a_compass_near_iron_gives_none_and_an_offset_is_taken_away():
    assert measured("qmc5883l", flying(), offset_z_ut=200.0) is None
    assert measured("qmc5883l", flying(), offset_z_ut=43.0, offset_x_ut=12.0) is None
    sensor, bus = begun("qmc5883l", rotation_deg=90.0)
    # North along the y axis of a chip whose x axis points to the right: the nose points south.
    bus.chips[0x0D].put(0x00, [0, 0, 0x58, 0x02, 0, 0, 1])
    assert sensor.read(Aircraft()).heading_deg == pytest.approx(180.0)
    assert sensor.read(Aircraft()) is None, "no new measurement"


@pytest.mark.parametrize("chip", [each for each in CHIPS if each != "ms4525do"])
def test_another_chip_at_the_address_is_refused(chip):
    sensor, bus = begun(chip)
    strange = RegisterChip()
    strange.registers[:] = b"\xa5" * 256
    bus.chips[sensor.address] = strange
    with pytest.raises(WrongChipError):
        sensor.begin()
