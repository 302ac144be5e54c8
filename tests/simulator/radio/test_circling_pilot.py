"""The pilot who circles: near and high for minutes, by the sticks of FBW alone."""

import pytest

from tests.simulator.bench import StillFlight
from tests.support.tools import unavailable
from up.commands.board_schema import FLIGHT_MODES
from up.earth import distance_m
from up_rig import RigUnavailableError
from up_rig.sticks import read_sticks
from up_simulator.aircraft import FlightDynamics, Weather, load_airframe
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import cached_eeprom
from up_simulator.harness.world import World
from up_simulator.radio.choice import ScriptedRadio
from up_simulator.radio.circling_pilot import CirclingPilot
from up_simulator.radio.sticks import Sticks, Transmitter


@pytest.mark.parametrize(
    ("airframe", "wind_m_s", "seconds"), [("glider", 4.0, 60), ("wing", 6.0, 30)]
)
def test_it_stays_near_and_high_in_turbulence(airframe, wind_m_s, seconds):
    """The firmware, built for this computer, holds the demand of the pilot's sticks."""
    flown = load_airframe(airframe)
    weather = Weather(wind_m_s=wind_m_s, turbulence="moderate")
    flight = FlightDynamics(flown, weather=weather, seed=3)
    try:
        board = choose_board("host", eeprom=cached_eeprom("host", flown.profile, flown.gains))
    except (BoardUnavailableError, RigUnavailableError) as error:
        unavailable(str(error))
    world, pilot, transmitter = World(flight, board), CirclingPilot(), Transmitter(board)
    world.boot(arms=True)
    home = flight.state
    for step in range(seconds * 500):
        transmitter.send(pilot.sticks(world.time_s, world.state))
        world.step()
        if step % 500 == 0:
            state = flight.state
            here = (home.latitude_deg, home.longitude_deg, state.latitude_deg, state.longitude_deg)
            assert flight.crash is None
            assert 90 < state.height_m < 150, world.time_s
            assert distance_m(*here) < 200, world.time_s
            assert abs(state.roll_deg) < 60


@pytest.mark.parametrize(
    ("airframe", "mode", "switch"), [("wing", "RATE", "AUTO"), ("glider", "ACRO", "ACRO")]
)
def test_it_flies_by_the_mode_that_the_board_says(airframe, mode, switch):
    """A ground station, or a switch, may choose modes that hold no attitude."""
    flown = load_airframe(airframe)
    flight = FlightDynamics(flown, weather=Weather(wind_m_s=4.0, turbulence="moderate"), seed=3)
    try:
        board = choose_board("host", eeprom=cached_eeprom("host", flown.profile, flown.gains))
    except (BoardUnavailableError, RigUnavailableError) as error:
        unavailable(str(error))
    tap = LineMonitor()
    pilot = CirclingPilot(switch=switch, mode=lambda: FLIGHT_MODES.get(tap.mode or "", ""))
    world, transmitter = World(flight, board), Transmitter(board)
    world.boot(arms=True)
    board.write(tap.start_bytes())
    for step in range(20 * 500):
        if step == 5 * 500 and mode == "RATE":
            board.write(tap.command_bytes("M", b"r"))
        transmitter.send(pilot.sticks(world.time_s, world.state))
        world.step()
        tap.feed(board.read(), world.time_s)
        assert flight.crash is None, world.time_s
        if step % 500 == 0:
            assert 90 < flight.state.height_m < 150, world.time_s
            assert abs(flight.state.roll_deg) < 60
            if step > 6 * 500:
                assert FLIGHT_MODES[tap.mode] == mode


def test_a_glider_without_a_motor_gets_no_throttle():
    assert CirclingPilot(has_motor=False).sticks(5.0, StillFlight().state).throttle == 1000


def test_a_script_takes_channels_from_the_pilot_for_good():
    moves = read_sticks("t=1 aileron=1900 t=2 receiver=off t=3 receiver=on")
    radio, state = ScriptedRadio(moves, CirclingPilot()), StillFlight().state
    assert radio.sticks(0.5, state).ailerons != 1900
    for time_s, is_on in ((1.0, True), (2.0, False), (3.0, True)):
        sticks = radio.sticks(time_s, state)
        assert (sticks.ailerons, sticks.is_on, sticks.mode) == (1900, is_on, "AUTO")


class Board:
    def __init__(self):
        self.told = []

    def set_stick(self, channel, width_us):
        self.told.append((channel, width_us))

    def set_receiver(self, is_on):
        self.told.append(("receiver", is_on))


def test_only_changes_are_sent_and_a_receiver_starts_switched_on():
    board = Board()
    transmitter = Transmitter(board)
    transmitter.send(Sticks())
    assert len(board.told) == 6
    board.told.clear()
    transmitter.send(Sticks(rudder=1600))
    transmitter.send(Sticks(rudder=1600, is_on=False))
    transmitter.send(Sticks(rudder=1600))
    assert board.told == [("rudder", 1600), ("receiver", False), ("receiver", True)]
