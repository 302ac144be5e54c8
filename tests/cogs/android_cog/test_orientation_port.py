import struct

import pytest

from tests.cogs.android_cog.flight import Flight
from tests.cogs.peers import UdpPeer
from tests.support.reactor import reactor, sleep, until
from up.commands.orientation_command import OrientationCommand
from up.commands.system_commands import SystemStopCommand
from up.mode import Mode
from up.providers.up_orientation_provider import UpOrientationProvider


def raw(*values):
    return struct.pack(">6f", *values)


def counters(flight):
    return flight.telemetry["counters"]["android"]


async def test_frames_arrive_as_commands_of_the_phone(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(OrientationCommand)
        gyro = await f.gyro()
        data = raw(1, 2, 3, 4, 5, 6) + raw(-1, -2, -3, 0, 0, 0)
        gyro.say(data[:5])
        gyro.say(data[5:30])
        gyro.say(data[30:])
        await until(lambda: len(f.heard) == 2)
        assert f.heard[0] == OrientationCommand(1, 2, 3, 4, 5, 6)
        assert f.up.get_module(UpOrientationProvider).reading.source == "android"


async def test_one_source_at_a_time(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(OrientationCommand)
        gyro, udp = await f.gyro(), UdpPeer(reactor)
        f.peers.append(udp)
        gyro.say(raw(1, 0, 0, 0, 0, 0))
        await until(lambda: f.heard)
        udp.say(raw(2, 0, 0, 0, 0, 0), f.up.ports["orientation"])
        await until(lambda: counters(f)["orientation_foreign"] == 1)
        assert [each.roll_deg for each in f.heard] == [1]

        async def repeated():
            udp.say(raw(3, 0, 0, 0, 0, 0), f.up.ports["orientation"])
            await sleep(0.05)
            return f.heard[-1].roll_deg == 3

        for _ in range(200):
            if await repeated():
                break
        else:
            raise AssertionError("UDP never took over from a silent connection")


STOPS = "stop if orientation connection is lost: true\nstop delay (s): 1\n"


@pytest.mark.parametrize(
    ("text", "mode"),
    [
        (STOPS, Mode.AUTO),
        (STOPS, Mode.FLIGHT_CONTROLLER),
        ("stop delay (s): 1\n", Mode.BLACK_BOX),
    ],
)
async def test_an_autopilot_is_never_stopped_by_the_phone(tmp_path, text, mode):
    async with Flight(tmp_path, text, mode) as f:
        f.listen_to(SystemStopCommand)
        gyro = await f.gyro()
        await until(lambda: f.provider._orientation.connected)
        await gyro.close()
        await until(lambda: not f.provider._orientation.connected)
        assert f.provider._stop_timer is None
        assert f.heard == []


async def test_a_black_box_stops_when_it_is_told_to(tmp_path):
    async with Flight(tmp_path, STOPS, Mode.BLACK_BOX) as f:
        f.listen_to(SystemStopCommand)
        gyro = await f.gyro()
        await until(lambda: f.provider._orientation.connected)
        lost_s = reactor.seconds()
        await gyro.close()
        await until(lambda: f.heard)
        assert reactor.seconds() - lost_s >= 0.99


async def test_coming_back_in_time_cancels_the_stop(tmp_path):
    async with Flight(tmp_path, STOPS.replace(": 1", ": 60"), Mode.BLACK_BOX) as f:
        f.listen_to(SystemStopCommand)
        gyro = await f.gyro()
        await until(lambda: f.provider._orientation.connected)
        await gyro.close()
        await until(lambda: f.provider._stop_timer)
        timer = f.provider._stop_timer
        await f.gyro()
        await until(lambda: f.provider._stop_timer is None)
        assert not timer.active()
        assert f.heard == []
