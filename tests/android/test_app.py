"""The app itself in the framework of Android 4.1 and 10, and at the real daemon and proxy."""

from __future__ import annotations

import re

import pytest

from tests.android.real_daemon import AIRCRAFT, RealDaemon
from tests.proxy.program import Program
from tests.support.android import ANDROID, make, need_android, need_jars

FIX = {"location__latitude": 49.74747, "location__longitude": 13.37759}


@pytest.fixture
def daemon(tmp_path):
    """A daemon behind a proxy."""
    with Program(tmp_path / "proxy") as proxy:
        made = RealDaemon(tmp_path / "daemon", proxy)
        try:
            made.start()
            made.proxy = proxy
            yield made
        finally:
            made.end()


def test_the_app_passes_its_tests_and_meets_the_daemon(daemon, tmp_path):
    need_android()
    need_jars("robolectric", "platforms")
    meeting = {
        "general": daemon.ports.general,
        "orientation": daemon.ports.orientation,
        "proxy": daemon.proxy.ground_port,
        "aircraft": AIRCRAFT,
    }
    options = " ".join(f"-Dmeeting.{name}={value}" for name, value in meeting.items())
    make("app-tests")
    pictures = f"PICTURES={tmp_path / 'pictures'}"
    said = make("test-app", f"ROBO_OPTIONS={options}", pictures, is_built=True)
    counted = re.search(r"^OK \((\d+) tests\)$", said, re.MULTILINE)
    assert counted and int(counted[1]) > 25, said
    # The daemon's own ground has received the airborne app's messages, too.
    daemon.ground.sees("what the phone sent", **FIX, android__batteryLevel=83)
    drawn = sorted(each.name for each in (tmp_path / "pictures").iterdir())
    assert drawn == [f"android-{name}.png" for name in ("airborne", "commands", "ground", "tablet")]


def test_only_the_loop_opens_sockets():
    """What calls the network's classes runs on the loop's threads, never on the screen's."""
    wanted = re.compile(r"\b(java\.nio\.channels|java\.net|javax\.net)\.")
    found = {
        each.relative_to(ANDROID).as_posix()
        for folder in ("core/src", "library", "raspilot/src")
        for each in (ANDROID / folder).rglob("*.java")
        if wanted.search(each.read_text(encoding="utf-8"))
    }
    loop = "core/src/org/raspilot/up/loop/"
    others = {each for each in found if not each.startswith(loop)}
    assert others == {
        # The addresses of a broadcast: read on the loop.
        "core/src/org/raspilot/up/net/InterfaceBroadcasts.java",
        # No sockets: engines of TLS, and addresses in a certificate; names are never looked up.
        "core/src/org/raspilot/up/tls/ServerTrust.java",
        "core/src/org/raspilot/up/tls/TlsConnection.java",
        "core/src/org/raspilot/up/tls/TlsIdentity.java",
        # Reads an address that the system wrote; names are never looked up there.
        "library/src-23/org/raspilot/up/android/api23/NetworkCalls.java",
    }
    assert len(found) > len(others)
