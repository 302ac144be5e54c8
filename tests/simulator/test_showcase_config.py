import socket
from dataclasses import astuple

from up_simulator.showcase_config import Ports, choose_ports, write_config


def test_a_port_that_only_udp_has_taken_is_not_chosen(monkeypatch):
    taken = socket.socket(type=socket.SOCK_DGRAM)
    taken.bind(("", 0))
    number = taken.getsockname()[1]
    monkeypatch.setattr(Ports.__init__, "__defaults__", (number,) * 6)
    try:
        assert number not in astuple(choose_ports())
    finally:
        taken.close()


def test_all_ports_differ():
    ports = astuple(choose_ports(any_ports=True))
    assert len(set(ports)) == len(ports)


def test_saved_gains_stay(tmp_path):
    write_config(tmp_path, tmp_path / "board", Ports())
    (tmp_path / "pids.yml").write_text("tuned")
    write_config(tmp_path, tmp_path / "board", Ports())
    assert (tmp_path / "pids.yml").read_text() == "tuned"


def test_two_showcases_do_not_share_a_folder(tmp_path, capsys):
    import fcntl

    from up_simulator.showcase import main

    with (tmp_path / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert main(["--folder", str(tmp_path)]) == 1
    assert "another showcase runs in" in capsys.readouterr().err


def test_the_flight_model_leaves_nothing_in_the_working_directory(tmp_path):
    import subprocess
    import sys

    code = (
        "from up_simulator.aircraft import FlightDynamics, airframe_names, load_airframe;"
        "[FlightDynamics(load_airframe(each)) for each in airframe_names()]"
    )
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True, timeout=60)
    assert list(tmp_path.iterdir()) == []
