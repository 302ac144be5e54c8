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


@pytest.mark.parametrize("key", ["", "wrong-key", "right-ke", "right-key ", "\ud800"])
def test_another_key_is_wrong(key):
    assert not ACCESS.is_key(key)
    assert not Access().is_key(key)


def test_who_has_shown_the_key_controls():
    assert ACCESS.is_key("right-key")
    assert ACCESS.denial(is_signed_in=True) is None
    assert ACCESS.denial(is_signed_in=False).code == "no_key"
    assert Access().denial(is_signed_in=False) is None
    access = Access(key="right-key", is_watch_only=True)
    assert access.denial(is_signed_in=True).code == "watch_only"


@pytest.mark.parametrize(
    ("peer", "origin", "is_https", "permitted"),
    [
        ("127.0.0.1", "http://127.0.0.1:8080", False, True),
        ("::1", "http://[::1]:8080", False, True),
        ("127.0.0.1", "http://localhost:8080", False, True),
        ("127.0.0.1", None, False, True),
        ("127.0.0.1", "https://ground.local", False, True),
        ("192.168.1.5", "https://192.168.1.9:8080", True, True),
        ("192.168.1.5", "http://192.168.1.9:8080", False, False),
        ("192.168.1.5", "http://127.0.0.1:8080", False, False),
        ("192.168.1.5", "https://ground.local", False, False),
        ("192.168.1.5", None, False, False),
        ("127.0.0.1", "http://ground.local", False, False),
        ("127.0.0.1", "http://192.168.1.9:8080", False, False),
    ],
)
def test_secrets_come_by_https_or_from_this_machine(peer, origin, is_https, permitted):
    assert ACCESS.permits_secrets(peer, origin, is_https) is permitted


def test_the_machine_has_names():
    names = machine_names(["Ground.Example"])
    assert {"localhost", "ground.example"} <= names
    assert "" not in names
