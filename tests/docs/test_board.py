"""The board of docs/how-to/board.md, at a pair of sockets."""

import importlib
import socket

import pytest

from tests.cogs.serial_cog.rig import VirtualReactor, run
from tests.docs.test_how_to import examples
from tests.support.application import importable
from tests.support.system import build_up, started
from up.commands.flight_state_command import FlightModeCommand
from up.commands.output_command import SetpointCommand
from up.commands.refusal import CommandRefusedError
from up.commands.rx_command import ALL_VALID, RXCommand
from up.providers.up_orientation_provider import UpOrientationProvider


@pytest.fixture
def aboard(tmp_path, monkeypatch):
    """The module, its system, and the board's end of the line."""
    folder = tmp_path / "text_boards"
    folder.mkdir()
    (folder / "text_board.py").write_text(examples("board.md")["modules/text_board.py"])
    ours, theirs = socket.socketpair()
    ours.setblocking(False)
    theirs.setblocking(False)
    with importable(tmp_path, "text_boards"):
        module = importlib.import_module("text_boards.text_board")
        monkeypatch.setattr(module, "open_serial", lambda *_: ours)
        up = build_up([module.TextBoard], VirtualReactor(), tmp_path / "config")
        life = run(started(up))
        yield up.get_module(module.TextBoard), up, theirs
        run(life.stop())
    theirs.close()


def test_the_board_of_the_page_flies_and_is_gone_when_it_is_silent(aboard):
    board, up, line = aboard
    reactor, sticks = up.context.reactor, []
    up.command_executor.register_command(RXCommand, sticks.append)
    assert up.vetoes.all == [f"text: {board.absent}"]
    line.send(b"\xff\nA 1\nA 10 -5.5 90\nR 1500 1500 1000 1500 2000 2000\nS 1 0\nnonsense\n")
    reactor.turn()
    assert up.get_module(UpOrientationProvider).reading.value.pitch_deg == -5.5
    assert sticks == [RXCommand(1500, 1500, 1000, 1500, 2000, 2000, ALL_VALID)]
    assert board.is_armed and up.vetoes.all == []
    # Without its switch it gets nothing.
    up.command_executor.execute_command(SetpointCommand(20.0, 3.0, throttle_us=1600))
    (take,) = up.command_executor.handlers_of(FlightModeCommand)
    with pytest.raises(CommandRefusedError):
        take(FlightModeCommand("LOITER"))
    line.send(b"S 1 1\n")
    reactor.turn()
    up.command_executor.execute_command(SetpointCommand(-20.0, 3.0, throttle_us=1600))
    assert line.recv(100) == b"P -20.0 3.0 1600\n"
    assert take(FlightModeCommand("LOITER")) is None
    up.vetoes.set("test", "no")
    line.send(b"S 0 1\n")
    reactor.turn()
    assert line.recv(100) == b"V 1\n"
    up.vetoes.clear("test")
    reactor.advance(0.6)
    assert not board.connected and board.is_armed is None
    assert up.vetoes.all == [f"text: {board.absent}"]
