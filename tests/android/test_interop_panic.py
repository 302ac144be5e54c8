"""Panic Mode reaches the Java phone: all that it sends slows down, and is quick again after it."""

import time

import pytest

from tests.android.phone_program import PhoneProgram
from tests.android.real_daemon import RealDaemon
from tests.cogs.android_cog.flight import Flight
from tests.support.reactor import run_in_reactor
from tests.support.reactor import until as soon
from tests.support.waiting import until
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.panic_command import PanicCommand

DELAY_MS = 1000
PANIC = (
    "panic threshold: 1\ncalm down threshold: 0\ninterval: 0.1\n"
    f"panic delay (ms): {DELAY_MS}\nnormal delay (ms): 20\n"
)
WINDOW_S = 4.0
"""At most five readings arrive in this time, six on a busy machine."""
MOST = 6


@pytest.fixture
def daemon(tmp_path):
    files = {"load_guard": PANIC, "disabled_modules": "disabled modules: []\n"}
    made = RealDaemon(tmp_path / "daemon", **files)
    yield made
    made.end()


def test_the_load_guard_of_the_daemon_slows_the_phone(daemon):
    ground = daemon.start()
    ground.sees("panic", load__panic=True)
    with PhoneProgram(*daemon.place, "--orientation", "tcp", "--orientation-hz", 200) as phone:
        phone.connected()
        phone.until(lambda: phone.all("panic"), "that it hears of it")
        assert phone.all("panic")[0]["delay_ms"] == DELAY_MS
        told = ground.frames
        until(lambda: ground.frames > told + 2, "telemetry of after that")
        begun_s = time.monotonic()
        begun = ground.at("counters.android.orientation_frames") or 0
        phone.until(lambda: time.monotonic() >= begun_s + WINDOW_S, "some time")
        assert ground.at("counters.android.orientation_frames") - begun <= MOST
        ground.sees("readings in spite of it", source__location="android")
    daemon.end()
    for topic in ("up.location.update", "up.orientation.update", "up.heading.change"):
        times_s = [time_s for time_s, _ in daemon.log_of(topic)]
        assert len(times_s) >= 2, topic
        # The frames sent before the phone received the Command, and one more at the end.
        assert sum(time_s > times_s[-1] - WINDOW_S for time_s in times_s) <= MOST, topic


def test_when_it_is_over_the_phone_is_quick_again(tmp_path):
    async def flight():
        async with Flight(tmp_path) as aircraft:
            ports = aircraft.up.ports
            place = f"127.0.0.1:{ports['general']}:{ports['orientation']}"
            aircraft.listen_to(OrientationCommand, LocationCommand)
            with PhoneProgram("--raspberry", place, "--orientation", "tcp") as phone:
                await soon(lambda: len(aircraft.heard) > 20, what="readings")
                publish = aircraft.up.command_executor.execute_command
                publish(PanicCommand(True, DELAY_MS, 91.5))
                await soon(lambda: phone.all("panic"), what="panic at the phone")
                slow, slow_s = await counted(aircraft, WINDOW_S)
                assert slow["orientation"] <= MOST and slow["location"] <= MOST
                assert slow["orientation"] >= 1 and slow["location"] >= 1
                publish(PanicCommand(False, 20))
                await soon(lambda: len(phone.all("panic")) == 2, what="its end at the phone")
                assert phone.all("panic")[1]["delay_ms"] == 0
                begun = len(aircraft.heard)
                begun_s = time.monotonic()
                await soon(lambda: len(aircraft.heard) > begun + 60, what="quick readings")
                quick_s = time.monotonic() - begun_s
                print(f"panic: {slow} in {slow_s:.1f} s; after it 60 in {quick_s:.1f} s")

    run_in_reactor(flight, timeout_s=120.0)


async def counted(aircraft, window_s):
    """Return how many of each reading came within a time, and the time."""
    del aircraft.heard[:]
    begun_s = time.monotonic()
    await soon(lambda: time.monotonic() >= begun_s + window_s, what="some time")
    took_s = time.monotonic() - begun_s
    counts = {"orientation": 0, "location": 0}
    for command in list(aircraft.heard):
        counts["orientation" if isinstance(command, OrientationCommand) else "location"] += 1
    return counts, took_s
