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


def test_any_ports_are_none_that_the_system_gives_to_whoever_connects():
    sets = choose_port_sets(3)
    ports = [port for each in sets for port in astuple(each)]
    assert len(set(ports)) == len(ports)
    given = Path("/proc/sys/net/ipv4/ip_local_port_range").read_text(encoding="ascii")
    first, last = map(int, given.split())
    assert not any(first <= port <= last for port in ports)
