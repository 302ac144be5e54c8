import socket
from dataclasses import astuple, fields
from pathlib import Path

from up_simulator.harness.ports import Ports, choose_port_sets, choose_ports


def test_a_port_that_only_udp_has_taken_is_not_chosen(monkeypatch):
    taken = socket.socket(type=socket.SOCK_DGRAM)
    taken.bind(("", 0))
    number = taken.getsockname()[1]
    monkeypatch.setattr(Ports.__init__, "__defaults__", (number,) * len(fields(Ports)))
    try:
        assert number not in astuple(choose_ports())
    finally:
        taken.close()


def test_all_ports_differ():
    ports = astuple(choose_ports(any_ports=True))
    assert len(set(ports)) == len(ports)


def test_the_ports_of_all_sets_differ_though_the_system_hands_them_out_again(monkeypatch):
    free = astuple(choose_ports(any_ports=True))
    more = astuple(choose_ports(any_ports=True))
    offered = iter([*free, *free, *more, *free, *more] * 3)

    class Socket(socket.socket):
        def bind(self, address):
            super().bind((address[0], address[1] or next(offered)))

    monkeypatch.setattr("up_simulator.harness.ports.socket.socket", Socket)
    chosen = [port for ports in choose_port_sets(2) for port in astuple(ports)]
    assert len(set(chosen)) == len(chosen) == 2 * len(fields(Ports))


def test_any_ports_are_none_that_the_system_gives_to_whoever_connects():
    sets = choose_port_sets(3)
    ports = [port for each in sets for port in astuple(each)]
    assert len(set(ports)) == len(ports)
    given = Path("/proc/sys/net/ipv4/ip_local_port_range").read_text(encoding="ascii")
    first, last = map(int, given.split())
    assert not any(first <= port <= last for port in ports)
