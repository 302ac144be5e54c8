"""The serial line as a module, on a real pty."""

import os
import termios
from types import SimpleNamespace

import pytest
from serial_cog.modules.serial_provider import SerialProvider

from tests.cogs.serial_cog.rig import Rig, VirtualReactor, run
from tests.support.system import build_up, started
from up.life_cycle import BootStoppedError
from up.mode import Mode
from up_simulator.firmware.wire import checked_frame


class Listener:
    def __init__(self):
        self.events = []

    def on_line_opened(self):
        self.events.append("opened")

    def on_line_lost(self):
        self.events.append("lost")

    def on_line_heard(self):
        self.events.append("heard")

    def on_line_silent(self):
        self.events.append("silent")


@pytest.fixture(params=["checked", "thesis"])
def rig(request, tmp_path):
    made = Rig([SerialProvider], tmp_path, request.param)
    yield made
    made.stop()


@pytest.fixture
def checked(tmp_path):
    made = Rig([SerialProvider], tmp_path)
    yield made
    made.stop()


def take(rig, letter="o", size=2):
    taken = []
    rig.module(SerialProvider).add_handler(letter, taken.append, size)
    return taken


def counts(rig):
    return rig.module(SerialProvider).telemetry_content["counters"]["serial"]


def test_frames_reach_the_handlers_of_their_type(rig):
    taken = take(rig)
    rig.start()
    rig.say("o", b"ab")
    rig.say("o", b"cd")
    assert taken == [b"ab", b"cd"]
    assert counts(rig)["frames"] == 2


def test_a_handler_added_while_the_line_runs_is_heard_and_counters_stay(rig):
    taken = take(rig)
    rig.start()
    rig.say("o", b"ab")
    late = take(rig, "q", 1)
    rig.say("q", b"!")
    rig.module(SerialProvider).remove_handler("o")
    rig.say("o", b"cd")
    assert (taken, late) == ([b"ab"], [b"!"])
    assert counts(rig)["frames"] == 2


def test_a_frame_is_sent_in_one_piece_with_its_sequence(checked):
    checked.start()
    serial = checked.module(SerialProvider)
    checked.port.raw()
    assert [serial.send_command("m"), serial.send_command(b"M", b"f")] == [0, 1]
    checked.turn()
    assert [(each.type, each.payload, each.sequence) for each in checked.port.heard] == [
        ("m", b"", 0),
        ("M", b"f", 1),
    ]


def test_a_zero_goes_first_so_that_old_bytes_spoil_no_frame(checked):
    checked.life = run(started(checked.up))
    checked.reactor.turn()
    assert checked.port.raw() == b"\0"


def test_nothing_is_sent_on_a_closed_line(checked):
    checked.port.unplug()
    with pytest.raises(BootStoppedError):
        checked.start()
    assert checked.module(SerialProvider).send_command("m") is None


def test_connected_means_frames_within_a_second(rig):
    take(rig)
    listener = Listener()
    rig.module(SerialProvider).add_listener(listener)
    rig.start()
    serial = rig.module(SerialProvider)
    assert not serial.connected
    rig.port.write(b"\xff\xfe\xfd")
    rig.turn()
    assert not serial.connected, "noise is no Arduino"
    rig.advance(0.3)
    rig.say("o", b"ab")
    assert serial.connected
    rig.advance(0.9)
    rig.say("o", b"cd")
    rig.advance(0.9)
    assert serial.connected
    rig.advance(0.2)
    assert not serial.connected
    assert listener.events == ["opened", "heard", "silent"]


def test_an_unfinished_frame_is_dropped_after_100_ms_of_silence(rig):
    taken = take(rig)
    rig.start()
    rig.port.write(rig.port.frame("o", b"ab")[:2])
    rig.turn()
    rig.advance(0.2)
    assert counts(rig)["timeouts"] == 1
    rig.say("o", b"cd")
    assert taken == [b"cd"]


def test_a_repeated_frame_is_handled_once_and_a_gap_is_counted(checked):
    taken = take(checked)
    checked.start()
    frame = checked_frame(7, "o", b"ab")
    checked.port.write(frame + frame)
    checked.port.write(checked_frame(10, "o", b"ab"))
    checked.turn()
    assert taken == [b"ab", b"ab"]
    assert counts(checked)["duplicates"] == 1


@pytest.mark.filterwarnings("ignore")
def test_a_handler_that_raises_harms_no_other(rig):
    def broken(payload):
        raise RuntimeError("a bug")

    rig.module(SerialProvider).add_handler("o", broken, 2)
    taken = take(rig)
    rig.start()
    rig.say("o", b"ab")
    rig.say("o", b"cd")
    assert taken == [b"ab", b"cd"]
    assert counts(rig)["failed_handlers"] == 2


def test_hang_up_on_close_is_cleared_so_that_reopening_resets_no_arduino(checked):
    control = termios.tcgetattr(checked.port.slave)[2]
    termios_flags = termios.tcgetattr(checked.port.slave)
    termios_flags[2] = control | termios.HUPCL
    termios.tcsetattr(checked.port.slave, termios.TCSANOW, termios_flags)
    checked.start()
    assert not termios.tcgetattr(checked.port.slave)[2] & termios.HUPCL


def test_a_port_that_comes_back_is_used_again_within_two_seconds(rig):
    taken = take(rig)
    listener = Listener()
    rig.module(SerialProvider).add_listener(listener)
    rig.start()
    rig.say("o", b"ab")
    rig.port.unplug()
    rig.turn()
    serial = rig.module(SerialProvider)
    assert not serial.is_source_open
    assert not serial.connected
    rig.advance(600)
    rig.port.plug_in()
    rig.advance(2.0)
    assert serial.is_source_open
    rig.say("o", b"cd")
    assert taken == [b"ab", b"cd"]
    assert listener.events == ["opened", "heard", "silent", "lost", "opened", "heard"]
    assert counts(rig)["lost"] == 1


def test_without_a_configured_port_the_arduino_is_found_when_it_comes(tmp_path):
    rig = Rig([SerialProvider], tmp_path, config={"arduino.yml": 'port: ""\n'})
    serial = rig.module(SerialProvider)
    ports = []
    serial.lister = lambda: ports
    with pytest.raises(BootStoppedError) as error:
        rig.start()
    assert error.value.code == "no_source"
    taken = take(rig)
    rig.advance(60)
    assert not serial.is_source_open
    device = os.ttyname(rig.port.slave)
    ports.append(SimpleNamespace(device=device, vid=0x1A86, pid=0x7523, serial_number=None))
    rig.advance(2.0)
    assert serial.is_source_open
    rig.say("o", b"ab")
    assert taken == [b"ab"]
    serial.on_stop()
    rig.stop()


def test_an_arduino_look_alike_that_says_nothing_is_passed_over(tmp_path):
    rig = Rig([SerialProvider], tmp_path / "a", config={"arduino.yml": 'port: ""\n'})
    other = Rig([SerialProvider], tmp_path / "b")
    silent, board = os.ttyname(other.port.slave), os.ttyname(rig.port.slave)
    serial = rig.module(SerialProvider)
    serial.lister = lambda: [
        SimpleNamespace(device=silent, vid=0x0403, pid=0x6001, serial_number="radio"),
        SimpleNamespace(device=board, vid=0x1A86, pid=0x7523, serial_number=None),
    ]
    taken = take(rig)
    rig.start()
    assert serial.port == silent
    rig.advance(9)
    assert serial.port == board
    for _ in range(20):
        rig.say("o", b"ab")
        rig.advance(0.5)
    assert serial.port == board
    assert taken == [b"ab"] * 20
    rig.stop()
    other.stop()


def test_in_black_box_mode_there_is_no_serial_line(tmp_path):
    up = build_up([SerialProvider], VirtualReactor(), tmp_path, mode=Mode.BLACK_BOX)
    assert up.get_module(SerialProvider) is None


def test_stopping_leaves_no_timer_and_no_reader(rig):
    take(rig)
    rig.start()
    rig.say("o", b"ab")
    rig.stop()
    assert not rig.reactor.readers
    assert not rig.reactor.getDelayedCalls()
