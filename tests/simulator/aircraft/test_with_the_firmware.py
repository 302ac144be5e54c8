"""Every shipped airframe with its own profile and gains, the compiled firmware in the loop.

A sign that is wrong anywhere between stick, mix, pulse, surface, IMU and PID shows here.
"""

import pytest

from tests.support.firmware import build_firmware
from tests.support.tools import unavailable
from up_simulator.aircraft import FlightDynamics, Start, airframe_names, load_airframe
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import cached_eeprom
from up_simulator.harness.world import World

NAMES = airframe_names()
LOW, MIDDLE = 1000.0, 1500.0


def airborne(name, aux1, kind="host", **start):
    """The host build is the same source as the chip's, and flies four times as fast."""
    airframe = load_airframe(name)
    try:
        eeprom = cached_eeprom(
            kind, airframe.profile, airframe.gains, divider=airframe.battery.divider
        )
        board = choose_board(kind, eeprom=eeprom)
    except BoardUnavailableError as error:
        unavailable(str(error))
    board.set_stick("aux1", aux1)
    world = World(FlightDynamics(airframe, Start(height_m=200.0, **start)), board)
    world.boot(arms=True)
    return world


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(("roll_deg", "pitch_deg"), [(50.0, -20.0), (-50.0, 15.0)])
def test_fbw_levels_the_aircraft(name, roll_deg, pitch_deg):
    world = airborne(name, MIDDLE, roll_deg=roll_deg, pitch_deg=pitch_deg)
    world.advance(2.5)
    assert abs(world.state.roll_deg) < 6.0
    world.advance(2.5)
    assert abs(world.state.roll_deg) < 3.0
    assert abs(world.state.pitch_deg) < 5.0
    assert world.dynamics.crash is None


@pytest.mark.parametrize(("name", "most_m"), [("glider", 13.0), ("wing", 19.0)])
def test_fbw_rolls_an_inverted_aircraft_upright_before_it_loses_much_height(name, most_m):
    """With the roll rate of upright flight the glider loses 21 m, the wing 28 m."""
    world = airborne(name, MIDDLE, roll_deg=180.0, pitch_deg=0.0)
    world.board.set_stick("throttle", 1490.0)
    states = [world.state]
    for _ in range(150):
        world.advance(0.02)
        states.append(world.state)
    assert world.dynamics.crash is None
    assert states[0].height_m - min(each.height_m for each in states) < most_m
    assert max(each.load_factor_g for each in states) < 3.0
    upright = next(at for at, each in enumerate(states) if abs(each.roll_deg) < 10.0)
    assert max(abs(each.roll_deg) for each in states[upright:]) < 12.0


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("aux1", [LOW, MIDDLE])
@pytest.mark.parametrize(("channel", "axis"), [("ailerons", "roll"), ("elevator", "pitch")])
def test_a_stick_banks_or_pitches_in_its_direction(name, aux1, channel, axis):
    world, hands_off = airborne(name, aux1), airborne(name, aux1)
    world.board.set_stick(channel, 1700.0)
    for each in (world, hands_off):
        each.advance(0.6)
    turned = getattr(world.state, f"{axis}_deg") - getattr(hands_off.state, f"{axis}_deg")
    assert turned > 3.0


def test_the_elevons_move_as_on_the_wiring_page():
    """Right: the left one (D9) down, the right one (D10) up; the nose up: both up."""
    build_firmware()
    world = airborne("wing", LOW, "firmware")
    for sticks, left_sign, right_sign in (((1700.0, 1500.0), -1, 1), ((1500.0, 1700.0), 1, 1)):
        world.board.set_stick("ailerons", sticks[0])
        world.board.set_stick("elevator", sticks[1])
        world.advance(0.2)
        left, right, *_ = world.board.pulses_us()
        assert left_sign * (left - 1500) > 150 and right_sign * (right - 1500) > 150


@pytest.mark.parametrize("name", NAMES)
def test_the_board_measures_the_battery_that_the_motor_empties(name):
    world, tap = airborne(name, MIDDLE), LineMonitor()

    def measured_v():
        world.board.write(tap.start_bytes())
        world.board.read()
        world.advance(0.4)
        tap.feed(world.board.read(), world.time_s)
        return tap.status.battery_mv / 1000

    full_v = measured_v()
    world.board.set_stick("throttle", 1800.0)
    world.advance(5.0)
    assert measured_v() == pytest.approx(world.state.battery_v, abs=0.05)
    assert full_v - measured_v() > 0.2
    assert world.dynamics.crash is None
