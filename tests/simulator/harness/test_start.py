"""``up-sim start`` with its board: a real process, a real pty, real time."""

import csv
import json
import os
import signal
import struct
import time

import pytest

from tests.simulator.program import Line, Program
from tests.support.firmware import build_firmware
from up.protocols.pairing import Pairing
from up_ground.key_store import KeyStore
from up_ground.token_store import state_folder
from up_simulator.firmware.rig_board import RigBoard
from up_simulator.harness.start_options import read_options


@pytest.fixture(scope="module", params=["host", "firmware"])
def kind(request):
    """Both kinds pass the same tests."""
    if request.param == "firmware":
        build_firmware()
    return request.param


def board(tmp_path, *arguments, kind="host"):
    link = tmp_path / "board"
    return Program("--no-phone", "--pty-link", link, "--board", kind, *arguments)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_it_makes_its_link_and_a_signal_removes_it_within_a_second(tmp_path, number):
    with board(tmp_path) as program:
        program.wait_for("board_ready", path=str(tmp_path / "board"))
        assert (tmp_path / "board").is_symlink()
        status, took_s, error = program.end(number)
    assert (status, error) == (0, "")
    # The program has one second, a loaded machine the rest.
    assert took_s < 5.0
    assert list(tmp_path.iterdir()) == []


def test_without_a_link_it_names_the_pty():
    with Program("--no-phone") as program:
        assert program.wait_for("board_ready").fields["path"].startswith("/dev/pts/")
        assert program.end()[0] == 0


def test_it_answers_on_its_real_line(tmp_path, kind):
    with board(tmp_path, kind=kind) as program:
        program.wait_for("board_ready")
        with Line(tmp_path / "board") as line:
            line.send("s")
            confirmed = line.wait_for_type("K")
            assert confirmed.payload == b"s\0"
            numbers = [
                struct.unpack(">H", line.wait_for_type("O").payload[:2])[0] for _ in range(50)
            ]
            assert numbers == list(range(numbers[0], numbers[0] + 50))
            line.send("G")
            assert len(line.wait_for_type("G").payload) == 72
            assert line.wait_for_type("x").payload[1:2] == b"f", "no demands"
        assert program.end()[0] == 0


def test_the_line_may_be_closed_and_opened_again(tmp_path):
    with board(tmp_path) as program:
        program.wait_for("board_ready")
        for _ in range(3):
            with Line(tmp_path / "board") as line:
                line.send("s")
                assert line.wait_for_type("K").payload[:1] == b"s"
                line.wait_for_type("O")
        assert program.end()[0] == 0


def test_a_reader_that_stops_does_no_harm(tmp_path):
    with board(tmp_path) as program:
        program.wait_for("board_ready")
        file = os.open(tmp_path / "board", os.O_RDWR | os.O_NOCTTY)
        with Line(tmp_path / "board") as line:
            line.send("s")
            line.wait_for_type("K")
        began_s = time.monotonic()
        while time.monotonic() - began_s < 2.0:
            time.sleep(0.05)  # an open line without a reader for two seconds: that is the test
        with Line(tmp_path / "board") as line:
            line.listener.feed(line.read())
            line.listener.take()
            line.send("m")
            assert line.wait_for_type("m").payload == b"f"
        os.close(file)
        assert program.end()[0] == 0


@pytest.mark.parametrize(
    "arguments",
    [
        ("--no-board", "--no-phone"),
        ("--sticks", "flaps=1500"),
        ("--wind", "fast"),
        ("--wind", "nan"),
        ("--general-port", "65536"),
        ("--runner", "nowhere"),
        ("--turbulence", "ligth"),
        ("--radio", "telepathy"),
        ("--controller", "flaps=1"),
        ("--airfram", "wing"),
        ("--elf", "missing.elf"),
        ("--gains", "missing.yml"),
        ("--model", "simple"),
        ("--state-log", "/nowhere/truth.csv"),
    ],
)
def test_a_wrong_option_ends_it_with_one_line_that_names_it(arguments, capsys):
    with pytest.raises(SystemExit) as ended:
        read_options(list(arguments))
    error = capsys.readouterr().err
    assert ended.value.code == 2
    assert arguments[0] in error and error.count("\n") == 1


@pytest.mark.parametrize("name", ["glidr", "brk"])
def test_an_unknown_airframe_is_a_wrong_option(name):
    with Program("--airframe", name) as program:
        assert program.process.wait(30) == 2
        error = program.error()
    assert name in error and error.count("\n") == 1


def test_a_file_in_place_of_the_link_is_left_alone(tmp_path):
    (tmp_path / "board").write_text("precious")
    with board(tmp_path) as program:
        assert program.process.wait(30) == 1
        error = program.error()
    assert str(tmp_path / "board") in error and error.count("\n") == 1
    assert (tmp_path / "board").read_text() == "precious"


@pytest.mark.parametrize(
    "arguments",
    [("--radio", "/nowhere/js7"), ("--radio", "keyboard")],
)
def test_a_flight_that_cannot_start_ends_with_one_line_that_names_the_cause(tmp_path, arguments):
    with board(tmp_path, *arguments) as program:
        assert program.process.wait(60) == 1
        error = program.error()
    assert json.loads(error)["fields"]["code"] == "start_failed" and error.count("\n") == 1, error
    assert arguments[1] in error
    assert not (tmp_path / "board").is_symlink()


def test_the_firmware_flies_and_its_attitude_is_the_truth(tmp_path):
    build_firmware()
    log = tmp_path / "truth.csv"
    with board(
        tmp_path, "--state-log", log, "--turbulence", "moderate", kind="firmware"
    ) as program:
        program.wait_for("board_selected", board=RigBoard.title)
        program.wait_for("board_ready")
        said = []
        with Line(tmp_path / "board") as line:
            line.send("s")
            while len(said) < 200:
                values = struct.unpack(">H6f", line.wait_for_type("O").payload)
                said.append((values[3], values[2]))
            status = line.wait_for_type("x").payload
        assert program.end()[0] == 0
    assert status[1:2] == b"f" and status[3] & 1, "FBW, armed"
    with log.open() as file:
        rows = list(csv.DictReader(file))
    truth = [(float(row["roll_deg"]), float(row["pitch_deg"])) for row in rows]
    for roll, pitch in said[::10]:
        assert min(max(abs(roll - a), abs(pitch - b)) for a, b in truth) < 4.5
    assert len({round(roll) for roll, _ in said}) > 5, "it banks into its circle"
    assert all(float(row["height_m"]) > 100 for row in rows)
    assert any(int(row["throttle_us"]) > 1300 for row in rows), "the motor runs"


def test_it_follows_a_script(tmp_path):
    build_firmware()
    script = "t=0.5 aux1=1000 aileron=1700 t=1 aileron=1500"
    with board(tmp_path, "--radio", "script", "--sticks", script, kind="firmware") as program:
        program.wait_for("board_ready")
        with Line(tmp_path / "board") as line:
            line.send("s")
            line.wait_for(lambda message: message.type == "x" and message.payload[1:2] == b"a")
        assert program.end()[0] == 0


def test_a_request_is_signed_by_the_paired_key_or_not_made(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    words = ["--runner", "127.0.0.1:3002", "--aircraft-name", "kite"]
    assert read_options(words).pairing is None
    with pytest.raises(SystemExit) as end:
        read_options([*words, "--signed"])
    assert end.value.code == 2
    pairing = Pairing("kite", "00" * 8, "00" * 32, "pilot", "phone")
    KeyStore(state_folder(os.environ)).put(pairing)
    assert read_options([*words, "--signed"]).pairing == pairing
