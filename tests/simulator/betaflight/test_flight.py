"""Raspilot flies through a Betaflight board: the real SITL, JSBSim, the real daemon, sockets.

SITL's ports are fixed: whatever uses them is in this file, one after the other.
"""

import json
import os
import signal
import socket
import time
from contextlib import closing, suppress
from dataclasses import replace
from pathlib import Path

import pytest
from msp_cog.codec import encode
from msp_cog.messages import SET_RAW_RC, pack_sticks

from tests.simulator.program import Program
from tests.simulator.scenarios.shipped import WITH_BETAFLIGHT, fly_real
from tests.support.tools import need_peer
from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import until
from up_simulator.aircraft import FlightDynamics, Weather, load_airframe
from up_simulator.betaflight.board import FRAME_US, SETTINGS, BetaflightBoard
from up_simulator.betaflight.packets import LINE, MSP_PORT, PWM_PORT
from up_simulator.betaflight.world import BetaflightWorld, NoLine
from up_simulator.demo.config import write_config
from up_simulator.firmware.board import BoardCrashedError
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.harness.ports import choose_ports
from up_simulator.harness.programs import RealRaspilot
from up_simulator.harness.real_time import RealTimeWorld
from up_simulator.harness.world import STEP_S, THROTTLE
from up_simulator.radio.rc_override import RadioLink
from up_simulator.radio.remote_messages import write_sticks
from up_simulator.radio.sticks import SWITCH_US, RadioError, Sticks

AUTO = Sticks(throttle=1550, aux1=SWITCH_US["AUTO"], aux2=2000)
FBW = replace(AUTO, aux1=SWITCH_US["FBW"])


class Flight:
    """The aircraft with its radio, the daemon, and the ground at its listener."""

    def __init__(self, folder, aircraft):
        self.config = folder / "config"
        write_config(
            self.config,
            Path("none"),
            choose_ports(True),
            controller="msp",
            airframe=load_airframe("glider"),
        )
        (self.config / "flight_state.yml").unlink()
        (self.config / "msp.yml").write_text(f"port: {LINE}\n")
        (self.config / "mission_control.yml").write_text(
            "role: pilot\nlistener: {port: 0, address: 127.0.0.1}\n"
        )
        self.aircraft = aircraft
        self.radio = RadioLink(folder / "radio")
        self.daemon = RealRaspilot(self.config, folder)
        self.daemon.start()
        port = int(self.daemon.wait_for("port_open", name="ground").fields["port"])
        self.ground = socket.create_connection(("127.0.0.1", port))
        self.ground.setblocking(False)
        self.sticks, self.frame, self.answers, self.sent, self._unread = AUTO, {}, {}, 0, b""

    @property
    def truth(self):
        return self.radio.snapshot.state

    def move_sticks(self):
        # After a pause of this process the next answer decides.
        with suppress(RadioError):
            self.radio.exchange(write_sticks(self.sticks))

    def poll(self):
        """Move the sticks, and take what the ground gets; return the newest telemetry."""
        self.move_sticks()
        with suppress(BlockingIOError):
            *lines, self._unread = (self._unread + self.ground.recv(1 << 20)).split(b"\n")
            for message in map(json.loads, lines):
                if message["name"] == "up.telemetry.update":
                    self.frame = message["data"]
                elif message["name"] in ("up.ack", "up.nack"):
                    self.answers[message["data"]["id"]] = message["data"]
        return self.frame

    def until(self, condition, what):
        return until(lambda: self.poll() and condition(self.frame), lambda: f"{what}: {self.seen}")

    @property
    def seen(self):
        names = ("armed", "flight_mode", "vetoes", "flight_control", "orientation", "rx", "home")
        return {name: self.frame.get(name) for name in names}, self.truth, self.daemon.log[-20:]

    def send(self, mode):
        """Request a flight mode and return the answer; a repeated id would get the first one."""
        self.sent += 1
        identity = str(self.sent)
        message = {"name": "up.flight_mode.set", "data": {"mode": mode}, "id": identity}
        self.ground.sendall(json.dumps(message).encode() + b"\n")
        self.until(lambda _: identity in self.answers, mode)
        return self.answers[identity]

    def close(self):
        self.ground.close()
        self.radio.close()
        self.daemon.kill()


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    folder = tmp_path_factory.mktemp("flight")
    options = (
        "--autopilot", "betaflight", "--sitl", need_peer("betaflight_SITL"), "--no-phone",
        "--turbulence", "none", "--radio-socket", folder / "radio",
    )  # fmt: skip
    with Program(*options) as aircraft:
        assert aircraft.wait_for("board_ready").fields["path"] == LINE
        flight = Flight(folder, aircraft)
        yield flight
        flight.close()
        assert aircraft.end()[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", WITH_BETAFLIGHT)
def test_the_shipped_scenario_holds(name, tmp_path):
    folders = (str(Path(need_peer("betaflight_SITL")).parent), os.environ["PATH"])
    fly_real(name, tmp_path, PATH=os.pathsep.join(folders))


def test_the_settings_that_the_cogs_page_advises_are_those_that_fly():
    page = (REPOSITORY / "cogs" / "msp_cog" / "README.md").read_text(encoding="utf-8")
    advised = page.split("```\n")[1].splitlines()
    flown = SETTINGS.read_text(encoding="utf-8").splitlines()
    assert len(advised) > 8 and set(advised) <= set(flown)


def test_without_the_program_and_without_its_settings_there_is_no_board(tmp_path):
    flight = FlightDynamics(load_airframe("glider"))
    with pytest.raises(BoardUnavailableError, match="no-such-program"):
        BetaflightBoard(flight, "no-such-program")
    # A file without the right to be executed, and one that is not a program.
    program = tmp_path / "sitl"
    for mode in (0o644, 0o755):
        program.write_bytes(b"\x7fELF")
        program.chmod(mode)
        with pytest.raises(BoardUnavailableError) as refused:
            BetaflightBoard(flight, str(program))
        assert "executed" in str(refused.value)
    # One that refuses the settings, and one that starts and sends no pulses, end immediately.
    for script in ("exit 1", "[ $# = 2 ]"):
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        with pytest.raises(BoardUnavailableError, match="sitl"):
            BetaflightBoard(flight, str(program))
    # Both have left the port.
    with socket.socket(type=socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", PWM_PORT))


class Companion:
    """A program on the board's line that never stops sending set-points, flown in this process."""

    def __init__(self):
        self.dynamics = FlightDynamics(load_airframe("glider"), weather=Weather(turbulence="none"))
        self.board = BetaflightBoard(self.dynamics, need_peer("betaflight_SITL"))
        self.world = BetaflightWorld(self.dynamics, self.board)
        self.world.boot(arms=True)
        self.line = socket.create_connection(("127.0.0.1", MSP_PORT))
        self.line.setblocking(False)
        self.payload = pack_sticks((1500, 1500, 1700, 1500))
        self.pilot = Sticks()
        # A busy computer flies late: set-points are sent all the same.
        self.flight = RealTimeWorld(self.world, NoLine(), self, self)

    def seconds(self):
        return time.monotonic()

    def sticks(self, time_s, state):
        return self.pilot

    def fly_until(self, condition):
        """Fly until the pulses fulfil a condition; return how many receiver frames that took."""
        begin_us = self.board.now_us

        def flies():
            self.flight.advance()
            self.line.send(encode(SET_RAW_RC, self.payload))
            with suppress(BlockingIOError):
                self.line.recv(4096)
            return condition(self.board.pulses_us())

        until(flies, lambda: f"pulses: {self.board.pulses_us()}")
        return (self.board.now_us - begin_us) / FRAME_US

    def move(self, **sticks):
        self.pilot = replace(self.pilot, **sticks)

    def close(self):
        self.line.close()
        self.board.close()


def test_the_boards_switch_ends_the_set_points_of_a_companion_that_never_stops():
    with closing(Companion()) as companion:
        companion.move(throttle=1200, aux1=SWITCH_US["FBW"], aux2=2000)
        companion.fly_until(lambda pulses: 1150 < pulses[THROTTLE] < 1300)
        companion.move(aux1=SWITCH_US["AUTO"])
        companion.fly_until(lambda pulses: pulses[THROTTLE] > 1600)
        companion.move(aux1=SWITCH_US["FBW"])
        # Two frames of 20 ms on an idle computer; a busy one takes time from the board.
        frames = companion.fly_until(lambda pulses: pulses[THROTTLE] < 1300)
        assert frames < 100
        companion.move(aux1=SWITCH_US["AUTO"])
        companion.fly_until(lambda pulses: pulses[THROTTLE] > 1600)
        # Roll and pitch alone leave the throttle to the pilot.
        companion.payload = pack_sticks((1500, 1500))
        companion.fly_until(lambda pulses: pulses[THROTTLE] < 1300)
        # A board that has ended is noticed, in the flight's time.
        companion.board._child.signal(signal.SIGKILL)
        with pytest.raises(BoardCrashedError):
            for _ in range(round(6.0 / STEP_S)):
                companion.world.step()


def turned(frame, other):
    return abs((frame["orientation"]["yaw"] - other["orientation"]["yaw"] + 180) % 360 - 180)


def test_raspilot_reads_receiver_attitude_position_and_arming(flight):
    flight.sticks = replace(FBW, ailerons=1700, rudder=1510)
    flight.until(lambda frame: frame["armed"], "armed")
    flight.until(lambda frame: (frame.get("rx") or {}).get("ailerons") == 1700, "the sticks")
    flight.until(
        lambda frame: (
            frame["orientation"]["roll"] > 8
            and abs(frame["orientation"]["roll"] - flight.truth.roll_deg) < 5
        ),
        "the bank of the sticks",
    )
    frame = flight.frame
    assert frame["flight_mode"] == "FBW" and frame["in_flight"]
    assert frame["rx"] == {"ailerons": 1700, "elevator": 1500, "throttle": 1550, "rudder": 1510,
                           "aux1": 1500, "aux2": 2000}  # fmt: skip
    assert frame["source"] == {**frame["source"], "orientation": "msp", "location": "msp"}
    assert frame["home"]["latitude"] == pytest.approx(50.0, abs=0.01)
    flight.sticks = FBW


def test_the_switch_lets_loiter_fly_and_ends_it(flight):
    assert flight.send("LOITER")["detail"] == "not_at_auto"
    flight.sticks = AUTO
    flight.until(lambda _: "code" not in flight.send("LOITER"), "LOITER")
    flight.until(
        lambda frame: (
            (frame["flight_mode"], frame["flight_control"]["mode"]) == ("SETPOINT", "LOITER")
        ),
        "set-points of LOITER",
    )
    before, height_m = flight.frame, flight.truth.height_m
    # The pilot's sticks are centred.
    flight.until(lambda frame: turned(frame, before) > 120, "a third of the circle")
    assert flight.truth.height_m == pytest.approx(height_m, abs=25)
    # RATE is the transmitter's alone: the request does not end LOITER.
    assert flight.frame["flight_control"]["board_modes"] == ["FBW"]
    assert flight.send("RATE")["detail"] == "mode_unknown"
    assert flight.frame["flight_control"]["selected"] == "LOITER"
    flight.sticks = replace(FBW, throttle=1610)
    flight.until(lambda frame: frame["flight_mode"] == "FBW", "the end of the set-points")
    flight.until(lambda frame: (frame.get("rx") or {}).get("throttle") == 1610, "the sticks")
    assert flight.frame["flight_control"]["mode"] is None


def test_return_comes_home(flight):
    flight.sticks = AUTO
    flight.until(lambda _: "code" not in flight.send("RETURN"), "RETURN")
    flight.until(
        lambda frame: (
            frame["flight_control"]["mode"] == "RETURN" and frame["home"]["distance"] < 65
        ),
        "home",
    )


def test_a_killed_daemon_leaves_the_aircraft_to_the_pilot(flight):
    side = 1 if flight.truth.roll_deg < 0 else -1
    # The switch stays at AUTO: the board drops the set-points.
    flight.sticks = replace(AUTO, ailerons=1500 + side * 350)
    flight.daemon.kill()

    def is_flown_by_the_pilot():
        flight.move_sticks()
        return flight.truth.roll_deg * side > 15

    until(is_flown_by_the_pilot, "the pilot's bank")
