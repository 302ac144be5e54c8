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
