import signal
from dataclasses import replace

import pytest
import yaml
from mission_control_cog.config import MISSION_CONTROL

from raspilot.flight_controller.flight_memory import MEMORY, Place
from up.config import PersistedFile
from up.config.keys_file import KEYS, add_key, revoke_key
from up_ground.key_store import KeyStore
from up_simulator.aircraft import load_airframe
from up_simulator.demo.config import write_config
from up_simulator.demo.keys import pair_ground, unpair_ground
from up_simulator.demo.main import main
from up_simulator.harness.ports import Ports

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def write(folder, controller="arduino", airframe="glider", **more):
    write_config(
        folder,
        folder / "board",
        Ports(),
        controller=controller,
        airframe=load_airframe(airframe),
        **more,
    )


def test_saved_gains_replace_the_airframes(tmp_path):
    write(tmp_path)
    gains = yaml.safe_load((tmp_path / "pids.yml").read_text())
    assert gains == load_airframe("glider").gains
    (tmp_path / "pids.yml").write_text("tuned")
    write(tmp_path)
    assert (tmp_path / "pids.yml").read_text() == "tuned"


def test_home_is_the_ground_below_the_launch(tmp_path):
    write(tmp_path)
    memory = PersistedFile(tmp_path / MEMORY.filename, MEMORY)
    values, problem = memory.load()
    assert (values.mode, values.home, problem) == ("", Place(50.0, 14.5, 250.0), None)
    memory.save(replace(values, mode="LOITER"))
    write(tmp_path)
    assert memory.load() == (values, None), "not that of an earlier flight"


def test_another_airframe_begins_with_its_own_gains(tmp_path):
    write(tmp_path)
    (tmp_path / "pids.yml").write_text("tuned for the glider")
    write(tmp_path, airframe="wing")
    assert yaml.safe_load((tmp_path / "pids.yml").read_text()) == load_airframe("wing").gains


def test_the_controller_changes_one_file(tmp_path):
    one, other = tmp_path / "arduino", tmp_path / "raspberry"
    for folder in (one, other):
        write(folder, controller=folder.name)

    def texts(folder):
        return {each.name: each.read_text().replace(str(folder), "") for each in folder.iterdir()}

    ours, theirs = texts(one), texts(other)
    differing = [name for name in ours if ours[name] != theirs[name]]
    assert differing == ["config.yml"]


def test_a_bad_link_is_between_aircraft_and_proxy(tmp_path):
    write(tmp_path, uplink_port=4711)
    mission = yaml.safe_load((tmp_path / "mission_control.yml").read_text())
    assert mission["remote_server"]["port"] == 4711
    assert yaml.safe_load((tmp_path / "proxy.yml").read_text())["airborne port"] == 3003


def test_two_demos_do_not_share_a_folder(tmp_path, capsys):
    import fcntl

    with (tmp_path / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert main(["--folder", str(tmp_path)]) == 1
    error = capsys.readouterr().err
    assert str(tmp_path) in error and "--folder" in error


@pytest.mark.parametrize(
    "words",
    [["--folder", "/proc/x"], ["--folder", __file__], ["--seconds", "nan"], ["--seconds", "0"]],
)
def test_a_wrong_folder_or_time_ends_with_status_2(words, capsys):
    try:
        status = main(words)
    except SystemExit as end:
        status = end.code
    assert status == 2
    error = capsys.readouterr().err
    assert words[0] in error and error.count("\n") == 1


def test_the_flight_model_leaves_nothing_in_the_working_directory(tmp_path):
    import subprocess
    import sys

    code = (
        "from up_simulator.aircraft import FlightDynamics, airframe_names, load_airframe;"
        "[FlightDynamics(load_airframe(each)) for each in airframe_names()]"
    )
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True, timeout=60)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "words",
    [
        ["--wind", "99"],
        ["--radio", "script"],
        ["--board", "chip"],
        ["--link", "dealy=5"],
        ["--page", "nowhere"],
        ["--model", "simple"],
        ["--state-log", "/nowhere/x.csv"],
    ],
)
def test_a_wrong_option_of_the_aircraft_is_refused_before_anything_starts(words, capsys):
    with pytest.raises(SystemExit) as end:
        main(words)
    error = capsys.readouterr().err
    assert end.value.code == 2
    assert words[0] in error and words[1] in error and error.count("\n") == 1


def test_an_unknown_airframe_is_refused_with_a_suggestion(tmp_path, capsys):
    before = {number: signal.getsignal(number) for number in SIGNALS}
    try:
        assert main(["--folder", str(tmp_path), "--airframe", "glidr"]) == 2
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    error = capsys.readouterr()
    assert "glidr" in error.err and "'glider'" in error.err and error.err.count("\n") == 1
    assert error.out == ""


def test_the_black_box_writes_into_the_folder_of_the_run(tmp_path):
    folder = tmp_path / 'a: "b" # c'
    folder.mkdir()
    write(folder / "config")
    black_box = yaml.safe_load((folder / "config" / "black_box.yml").read_text())
    assert black_box == {"folder": str(folder / "flights")}
    board = yaml.safe_load((folder / "config" / "arduino.yml").read_text())
    assert board == {"port": str(folder / "config" / "board")}


def mode(path):
    return path.stat().st_mode & 0o777


def test_the_ground_station_is_paired_once_and_other_devices_stay(tmp_path):
    config, state = tmp_path / "config", tmp_path / "ground"
    write(config)
    ground = pair_ground(config, state)
    assert (ground.name, ground.role) == ("ground", "pilot")
    assert mode(config / "keys.yml") == mode(state / "keys.txt") == 0o600
    add_key(config, "tablet", "observer")
    assert pair_ground(config, state) == ground == KeyStore(state).get("default")
    assert [each.name for each in KEYS.load(config).keys.values()] == ["ground", "tablet"]
    revoke_key(config, "ground")
    assert pair_ground(config, state).key_id != ground.key_id


def test_plain_leaves_the_ground_station_without_a_key(tmp_path):
    config, state = tmp_path / "config", tmp_path / "ground"
    write(config)
    pair_ground(config, state)
    keyed = MISSION_CONTROL.load(config)
    assert (keyed.remote_server.security, keyed.role) == ("require", "operator")
    write(config, is_plain=True)
    unpair_ground(state)
    plain = MISSION_CONTROL.load(config)
    assert (plain.remote_server.security, plain.role) == ("auto", "pilot")
    assert KeyStore(state).all() == {}


def test_keys_that_others_may_read_end_it(tmp_path, capsys):
    config = tmp_path / "config"
    config.mkdir()
    (config / "keys.yml").write_text("keys: {}\n")
    (config / "keys.yml").chmod(0o644)
    before = {number: signal.getsignal(number) for number in SIGNALS}
    try:
        assert main(["--folder", str(tmp_path), "--any-ports"]) == 2
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    assert "chmod 600" in capsys.readouterr().err
