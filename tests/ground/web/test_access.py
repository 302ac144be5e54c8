"""Permission to view, and permission to control."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_ground.web.access import Access, machine_names

ACCESS = Access(frozenset({"localhost", "ground.local"}), key="right-key")


@pytest.mark.parametrize(
    "host",
    [
        "127.0.0.1:8080",
        "192.168.1.5",
        "[::1]:8080",
        "[fe80::1%eth0]:80",
        "localhost:1",
        "LOCALHOST",
        "ground.local:8080",
        "ground.local.:8080",
    ],
)
def test_addresses_and_the_machines_names_are_it(host):
    assert ACCESS.permits_host(host)


@pytest.mark.parametrize(
    "host",
    [
        None,
        "",
        "evil.example",
        "evil.example:8080",
        "127.0.0.1.evil.example",
        "localhost.evil.example",
        "localhost@evil.example",
        "127.0.0.1:8080 evil",
        "[evil.example]",
        "127.0.0.1:port",
        "[::1",
        "a" * 300,
    ],
)
def test_other_names_are_not(host):
    assert not ACCESS.permits_host(host)


@given(st.text(max_size=60))
def test_no_host_raises(host):
    assert ACCESS.permits_host(host) in (True, False)
    assert ACCESS.permits_origin(host, host) in (True, False)


@pytest.mark.parametrize(
    ("origin", "permitted"),
    [
        (None, True),
        ("http://127.0.0.1:8080", True),
        ("https://127.0.0.1:8080", True),
        ("http://127.0.0.1:9999", False),
        ("http://127.0.0.1", False),
        ("http://evil.example", False),
        ("null", False),
        ("", False),
        ("file://127.0.0.1:8080", False),
        ("http://127.0.0.1:8080@evil.example", False),
        ("http://evil.example/127.0.0.1:8080", False),
    ],
)
def test_only_the_servers_own_page_opens_a_link(origin, permitted):
    assert ACCESS.permits_origin(origin, "127.0.0.1:8080") is permitted


@pytest.mark.parametrize("key", [None, "", "wrong-key", "right-ke", "right-key ", 7, "\ud800"])
def test_without_the_key_a_page_watches(key):
    assert ACCESS.denial(key).code == ("wrong_key" if isinstance(key, str) else "no_key")


def test_with_the_key_it_controls():
    assert ACCESS.denial("right-key") is None
    assert Access().denial(None) is None
    access = Access(key="right-key", is_watch_only=True)
    assert access.denial("right-key").code == "watch_only"


def test_the_machine_has_names():
    names = machine_names(["Ground.Example"])
    assert {"localhost", "ground.example"} <= names
    assert "" not in names
