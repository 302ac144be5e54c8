"""`up check` names every link that may leave the machine in plain, with the key that decides."""

import argparse
from pathlib import Path

import pytest

from up.cli.verbs import system_of

ROOT = Path(__file__).parents[2]
PHONE, RELAY = "address", "remote_server.security"


@pytest.mark.parametrize(
    ("android", "mission_control", "named"),
    [
        ("", "", {PHONE}),
        ("address: 127.0.0.1", "", set()),
        ("i_accept_plain: true", "", {"i_accept_plain"}),
        ("", "remote_server: {url: 192.0.2.1}", {PHONE, RELAY}),
        ("", "remote_server: {url: 127.0.0.1}", {PHONE}),
        ("", "remote_server: {url: 192.0.2.1, security: require}", {PHONE}),
        ("", "remote_server: {url: 192.0.2.1, security: accept}", {PHONE, RELAY}),
        ("", "remote_server: {url: 192.0.2.1, tls: certificates/a, security: accept}", {PHONE}),
        ("", "listener: {port: 50002}", {PHONE, "listener.security"}),
        ("", "listener: {port: 50002, security: require}", {PHONE}),
        ("", "secrecy: require\nremote_server: {url: 192.0.2.1}", {PHONE}),
    ],
)
def test_plain_links_are_named(tmp_path, android, mission_control, named):
    (tmp_path / "android.yml").write_text(android, encoding="utf-8")
    (tmp_path / "mission_control.yml").write_text(mission_control, encoding="utf-8")
    chosen = argparse.Namespace(file=str(ROOT / "raspilot"), config=tmp_path, mode=None)
    warnings = system_of(chosen).check().warnings
    assert {each.fields["key"] for each in warnings if each.code == "link_plain"} == named
