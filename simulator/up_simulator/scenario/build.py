"""Builds the participants of a scenario: aircraft, board, participants."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from typing import Any

from up_flightlog.read.demand import DemandModel
from up_simulator.aircraft import Airframe, FlightDynamics, Start, load_airframe
from up_simulator.aircraft.model import fall_back_note
from up_simulator.betaflight.board import BetaflightBoard
from up_simulator.betaflight.world import BetaflightWorld
from up_simulator.firmware.board import FirmwareBoard
from up_simulator.firmware.build import choose_board
from up_simulator.firmware.preparation import cached_eeprom
from up_simulator.harness.user_log import text_log
from up_simulator.harness.world import World
from up_simulator.in_process.config_folder import merge
from up_simulator.scenario.flight import ScenarioFlight
from up_simulator.scenario.line_board import LineBoard, SerialWires
from up_simulator.scenario.participants import Participants
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.sticks import SWITCH_US, StickTimeline

Notify = Callable[[str], None]


def build_flight(scenario: Scenario, notify: Notify = lambda _text: None) -> ScenarioFlight:
    """Return a flight that is ready to boot.

    Raises AirframeError, FlightUnavailableError, BoardUnavailableError, SettingsError,
    PreparationError, BoardCrashedError and ParticipantError, each with one sentence for the user.
    """
    airframe = load_airframe(scenario.airframe)
    dynamics = FlightDynamics(
        airframe,
        start=_start(scenario),
        weather=scenario.weather,
        seed=scenario.seed,
        may_land=scenario.may_land,
        model=scenario.model,
    )
    if note := fall_back_note(scenario.model, dynamics.model):
        notify(note)
    if scenario.board == "betaflight":
        betaflight = BetaflightBoard(dynamics, seed=scenario.seed)
        board = _on_line(scenario, betaflight)
        world: World = BetaflightWorld(dynamics, betaflight, board)
    else:
        board = _board(scenario, airframe, notify)
        world = World(dynamics, board)
    try:
        participants = _participants(scenario, airframe, dynamics, board)
    except BaseException:
        world.close()
        raise
    demand = DemandModel(profile_of(scenario, airframe.profile))
    flight = ScenarioFlight(scenario, world, board, participants, demand, airframe.imu)
    flight.record.settings = _settings(scenario, airframe)
    flight.record.model = dynamics.model
    return flight


def _settings(scenario: Scenario, airframe: Airframe) -> dict[str, dict[str, Any]]:
    return {
        "airframe.yml": profile_of(scenario, airframe.profile),
        "pids.yml": gains_of(scenario, airframe.gains),
        "navigation.yml": airframe.navigation,
    }


def _board(scenario: Scenario, airframe: Airframe, notify: Notify) -> LineBoard:
    assert scenario.board != "betaflight"
    eeprom = b""
    if scenario.eeprom != "blank":
        profile, gains = profile_of(scenario, airframe.profile), gains_of(scenario, airframe.gains)
        eeprom = cached_eeprom(
            scenario.board,
            profile,
            gains,
            text_log(notify),
            divider=airframe.battery.divider,
        )
    if scenario.eeprom == "spoiled":
        eeprom = corrupted(eeprom, scenario.seed)
    board = choose_board(
        scenario.board,
        seed=scenario.seed,
        imu_errors=scenario.imu.errors(airframe.imu, scenario.seed),
        eeprom=eeprom,
        log=text_log(notify),
    )
    return _on_line(scenario, board)


def _on_line(scenario: Scenario, board: FirmwareBoard) -> LineBoard:
    delay_us = scenario.receiver.delay_ms * 1000
    return LineBoard(board, SerialWires(scenario.seed), delay_us)


def _participants(
    scenario: Scenario, airframe: Airframe, dynamics: FlightDynamics, board: LineBoard
) -> Participants:
    if not scenario.has_raspilot:
        return Participants(board)
    settings = _settings(scenario, airframe)
    if scenario.ground is not None:
        settings["mission_control.yml"] = {"role": scenario.ground.role}
    # Imported here: only flights with the daemon need Twisted and the daemon.
    if scenario.is_real:
        from up_simulator.scenario.real_participants import RealParticipants

        return RealParticipants(scenario, dynamics, board, settings)
    from up_simulator.scenario.in_process_participants import InProcessParticipants

    return InProcessParticipants(scenario, dynamics, board, settings)


def _start(scenario: Scenario) -> Start:
    start = scenario.start
    values = {name: getattr(start, name) for name in start.__slots__}
    if start.throttle is None:
        sticks = StickTimeline(scenario.sticks, scenario.switch.positions()).pulses_us(0.0)
        runs = sticks["aux2"] > SWITCH_US["middle"] or scenario.board == "direct"
        values["throttle"] = min(1.0, max(0.0, sticks["throttle"] / 1000 - 1)) if runs else 0.0
    throws = (event.throw for event in scenario.events if event.throw is not None)
    return Start(**values, throw_m_s=next(throws, None))


CORRUPTION_INTERVAL = 7


def profile_of(scenario: Scenario, profile: Mapping[str, Any]) -> dict[str, Any]:
    """Return the profile (as airframe.yml) that the board flies by."""
    merged = merge(profile, scenario.profile)
    return merge(merged, {"switch": scenario.switch.positions()})


def gains_of(scenario: Scenario, gains: Mapping[str, Any]) -> dict[str, Any]:
    """Return the gains (as pids.yml) that the board flies by."""
    return merge(gains, scenario.gains)


def corrupted(eeprom: bytes, seed: int) -> bytes:
    """Return an EEPROM's contents with a wrong bit in every seventh byte."""
    noise = random.Random(f"eeprom {seed}")
    return bytes(
        byte ^ (1 << noise.randrange(8)) if at % CORRUPTION_INTERVAL == 0 else byte
        for at, byte in enumerate(eeprom)
    )
