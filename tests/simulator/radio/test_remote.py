"""A radio in another terminal: it takes the sticks, shows the mode, and releases them."""

import os
import pty
import select
import signal
import socket
import subprocess
import sys
import termios
import threading
import time
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.simulator.bench import StillFlight
from tests.support.tools import unavailable
from up_rig import RigUnavailableError
from up_simulator.aircraft import FlightDynamics, load_airframe
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.firmware.preparation import cached_eeprom
from up_simulator.harness.user_log import no_log
from up_simulator.harness.world import World
from up_simulator.radio.choice import ScriptedRadio
from up_simulator.radio.circling_pilot import CirclingPilot
from up_simulator.radio.keyboard import HELP
from up_simulator.radio.keyboard_radio import status_line
from up_simulator.radio.rc_override import RadioLink
from up_simulator.radio.remote import RemoteRadio
from up_simulator.radio.remote_messages import (
    Snapshot,
    read_snapshot,
    read_sticks_of,
    write_snapshot,
    write_sticks,
)
from up_simulator.radio.sticks import RadioError, Sticks, Transmitter
from up_simulator.radio.terminal import wrapped

DEADLINE_S = 30.0
STATE = StillFlight().state
OTHER = Sticks(ailerons=1700, throttle=1400, aux1=1500, aux2=2000)


class Aircraft:
    """The aircraft's end, moved on by hand."""

    def __init__(self, path):
        self.logged = []
        self.radio = RemoteRadio(path, ScriptedRadio([]), self.log, lambda: "FBW")
        self.time_s = 0.0

    def log(self, _text, /, *, code):
        self.logged.append(code)

    def sticks(self, passed_s=0.02):
        self.time_s += passed_s
        return self.radio.sticks(self.time_s, STATE)


class Pilot:
    """A sender whose datagrams are written by the test."""

    def __init__(self, path):
        self.path = path
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind("")
        self.socket.setblocking(False)

    def send(self, datagram):
        self.socket.sendto(datagram, str(self.path))

    def seen(self):
        return read_snapshot(self.socket.recv(4096))


@pytest.fixture
def aircraft(tmp_path):
    made = Aircraft(tmp_path / "radio")
    yield made
    made.radio.close()


@pytest.fixture
def pilot(tmp_path, aircraft):
    made = Pilot(tmp_path / "radio")
    yield made
    made.socket.close()


def test_the_sticks_are_taken_shown_and_released(aircraft, pilot):
    assert aircraft.sticks() == Sticks()
    pilot.send(write_sticks(OTHER))
    assert aircraft.sticks() == OTHER
    seen = pilot.seen()
    assert (seen.mode, seen.sticks) == ("FBW", OTHER)
    assert seen.state.roll_deg == STATE.roll_deg and seen.state.height_m == STATE.height_m
    pilot.send(write_sticks(None))
    assert aircraft.sticks() == Sticks()
    assert aircraft.logged == ["sticks_taken", "sticks_released"]


def test_a_radio_silent_for_a_second_loses_the_sticks(aircraft, pilot):
    pilot.send(write_sticks(OTHER))
    assert aircraft.sticks() == OTHER
    assert aircraft.sticks(0.9) == OTHER
    assert aircraft.sticks(0.2) == Sticks()


def test_a_second_radio_only_watches(aircraft, pilot, tmp_path):
    pilot.send(write_sticks(OTHER))
    aircraft.sticks()
    second = Pilot(tmp_path / "radio")
    second.send(write_sticks(Sticks(ailerons=1000)))
    second.send(write_sticks(None))
    assert aircraft.sticks() == OTHER
    answers = [second.seen(), second.seen()]
    assert [(each.sticks, each.is_taken_by_other) for each in answers] == [(OTHER, True)] * 2
    assert not pilot.seen().is_taken_by_other
    second.socket.close()


def test_a_second_radio_is_refused_immediately(aircraft, pilot, tmp_path):
    pilot.send(write_sticks(OTHER))
    aircraft.sticks()
    is_requested, refusals = threading.Event(), []

    def take():
        is_requested.set()
        try:
            RadioLink(tmp_path / "radio")
        except RadioError as error:
            refusals.append(error.code)

    second = threading.Thread(target=take)
    second.start()
    is_requested.wait(DEADLINE_S)
    while second.is_alive():
        aircraft.sticks(0.0)
    second.join()
    assert refusals == ["sticks_taken"]


class Flown:
    """The firmware in the air with the circling pilot, whose sticks another radio may take."""

    def __init__(self, path):
        airframe = load_airframe("glider")
        try:
            self.board = choose_board(
                "host", eeprom=cached_eeprom("host", airframe.profile, airframe.gains)
            )
        except (BoardUnavailableError, RigUnavailableError) as error:
            unavailable(str(error))
        self.monitor = LineMonitor()
        self.radio = RemoteRadio(path, CirclingPilot(), no_log, is_armed=self.is_armed)
        self.world = World(FlightDynamics(airframe), self.board)
        self.transmitter = Transmitter(self.board)
        self.world.boot(arms=True)
        self.board.write(self.monitor.start_bytes())

    def is_armed(self):
        return None if self.monitor.status is None else self.monitor.status.is_armed

    def fly(self, seconds, before_each=lambda: None):
        for step in range(round(seconds * 500)):
            if step % 50 == 0:
                before_each()
            self.transmitter.send(self.radio.sticks(self.world.time_s, self.world.state))
            self.world.step()
            self.monitor.feed(self.board.read(), self.world.time_s)


@pytest.mark.parametrize("disarmed_s", [0.5, 3.0])
def test_the_pilot_rearms_an_aircraft_that_was_disarmed(tmp_path, disarmed_s):
    """The throttle low, AUX2 from low to high, and the motor again: no other way arms a board."""
    flown = Flown(tmp_path / "radio")
    flown.fly(1.0)
    other = Pilot(tmp_path / "radio")
    disarmed = Sticks(throttle=1600, aux1=1500, aux2=1000)
    flown.fly(disarmed_s, lambda: other.send(write_sticks(disarmed)))
    assert flown.board.pulses_us()[2] < 1010, "the motor is off"
    other.send(write_sticks(None))
    flown.fly(5.0)
    assert flown.is_armed()
    assert flown.board.pulses_us()[2] > 1200
    flown.fly(10.0)
    assert flown.world.state.height_m > 100
    other.socket.close()
    flown.radio.close()


def test_the_status_line_shows_switch_and_mode_where_they_differ():
    at_auto = Sticks(aux1=2000, aux2=2000)
    assert " AUTO, flies FBW armed " in status_line(at_auto, STATE, "FBW")
    assert " AUTO armed " in status_line(at_auto, STATE)
    assert " FBW armed " in status_line(replace(at_auto, aux1=1500), STATE, "FBW")
    assert len(status_line(at_auto, STATE, "FBW")) < 80


@pytest.mark.parametrize("columns", [40, 60, 80, 200])
def test_the_help_is_wrapped_by_words(columns):
    lines = [part for line in HELP.splitlines() for part in wrapped(line, columns).splitlines()]
    assert max(map(len, lines)) <= columns
    assert " ".join(lines).split() == HELP.split()
    assert "spring back" in HELP


def test_invalid_datagrams_move_nothing(aircraft, pilot):
    for datagram in (b"", b"{}", b"[]", b"\xff", b'{"sticks": {"ailerons": 1500}}', b"[" * 2000):
        pilot.send(datagram)
    assert aircraft.sticks() == Sticks()
    assert aircraft.logged == []


def test_the_socket_is_removed_with_the_aircraft(tmp_path):
    aircraft = Aircraft(tmp_path / "radio")
    aircraft.radio.close()
    assert list(tmp_path.iterdir()) == []


def test_an_old_socket_is_replaced_and_a_file_is_not(tmp_path):
    first = Aircraft(tmp_path / "radio")
    Aircraft(tmp_path / "radio").radio.close()
    first.radio.close()
    (tmp_path / "file").write_text("mine")
    with pytest.raises(RadioError) as error:
        Aircraft(tmp_path / "file")
    assert error.value.code == "socket_unusable"
    assert (tmp_path / "file").read_text() == "mine"


def test_a_radio_without_an_aircraft_is_refused(tmp_path):
    with pytest.raises(RadioError) as error:
        RadioLink(tmp_path / "radio")
    assert error.value.code == "no_aircraft"


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
        lambda inner: st.dictionaries(
            st.sampled_from(["sticks", "ailerons", "is_on", "mode", "roll_deg"]), inner
        ),
    )
)
def test_any_object_is_read_or_refused(found):
    import json

    for read in (read_sticks_of, read_snapshot):
        try:
            read(json.dumps(found).encode())
        except ValueError:
            continue


def test_written_messages_are_read_back():
    assert read_sticks_of(write_sticks(OTHER)) == OTHER
    assert read_sticks_of(write_sticks(None)) is None
    assert read_snapshot(write_snapshot(Snapshot(STATE, OTHER, "FBW"))).sticks == OTHER


class Terminal:
    """``up-sim radio keyboard`` in its own terminal."""

    def __init__(self, path):
        self.own, self.other = pty.openpty()
        self.before = termios.tcgetattr(self.other)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "up_simulator", "radio", "keyboard", "--socket", str(path)],
            stdin=self.other, stdout=self.other, stderr=self.other, start_new_session=True,
        )  # fmt: skip
        self.shown = ""

    def read(self):
        while select.select([self.own], [], [], 0.01)[0]:
            self.shown += os.read(self.own, 4096).decode()

    def is_as_before(self):
        return termios.tcgetattr(self.other) == self.before

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        os.close(self.own)
        os.close(self.other)


@pytest.fixture
def terminal(aircraft, tmp_path):
    made = Terminal(tmp_path / "radio")
    yield made
    made.close()


def fly_until(aircraft, terminal, condition, what):
    deadline_s = time.monotonic() + DEADLINE_S
    while not condition(aircraft.sticks()):
        terminal.read()
        assert terminal.process.poll() is None, terminal.shown
        assert time.monotonic() < deadline_s, f"never: {what}; {terminal.shown}"
    return True


def test_keys_of_a_terminal_fly_it_and_q_releases_it(aircraft, terminal):
    fly_until(aircraft, terminal, lambda _: len(aircraft.logged) == 1, "the sticks are taken")
    fly_until(aircraft, terminal, lambda _: "FBW" in terminal.shown, "the line")
    assert "arming switch" in terminal.shown, "the help"
    assert not terminal.is_as_before()
    os.write(terminal.own, b"\x1b[C1 w")
    fly_until(aircraft, terminal, lambda s: s.ailerons > 1500, "the stick moves")
    fly_until(aircraft, terminal, lambda s: s.mode == "ACRO" and s.is_armed, "the switches")
    os.write(terminal.own, b"q")
    deadline_s = time.monotonic() + DEADLINE_S
    while terminal.process.poll() is None:
        aircraft.sticks(0.001)
        terminal.read()
        assert time.monotonic() < deadline_s
    assert terminal.process.returncode == 0
    assert aircraft.sticks(0.001) == Sticks(), "immediately, not after a second"
    assert terminal.is_as_before()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_a_signal_restores_the_terminal(aircraft, terminal, number):
    fly_until(aircraft, terminal, lambda _: len(aircraft.logged) == 1, "the sticks are taken")
    terminal.process.send_signal(number)
    terminal.process.wait(DEADLINE_S)
    assert terminal.is_as_before()


def test_the_end_of_the_aircraft_restores_the_terminal(aircraft, terminal):
    fly_until(aircraft, terminal, lambda _: len(aircraft.logged) == 1, "the sticks are taken")
    aircraft.radio.close()
    assert terminal.process.wait(DEADLINE_S) == 1
    terminal.read()
    assert "up-sim radio: " in terminal.shown
    assert "Traceback" not in terminal.shown
    assert terminal.is_as_before()
