import json
import socket

import pytest
from twisted.logger import globalLogPublisher

from tests.cogs.android_cog.flight import Flight
from tests.cogs.peers import UdpPeer, connect
from tests.support.reactor import reactor, until
from tests.support.tools import unavailable
from up.commands.arming_commands import ArmCommand
from up.commands.location_command import LocationCommand
from up.commands.panic_command import PanicCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand
from up.commands.system_commands import LinkStateCommand, SystemStopCommand
from up.commands.telemetry_commands import TelemetryCommand
from up.life_cycle import BootStoppedError
from up.mode import Mode
from up.providers.up_location_provider import UpLocationProvider


def battery(level, **more):
    return {"name": "android.battery", "data": {"level": level}, **more}


def shown(flight):
    android = flight.telemetry["android"]
    return android["connected"], android["batteryLevel"]


async def test_what_the_phone_says_is_known_by_its_source(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(LinkStateCommand)
        phone = await f.phone()
        phone.say(
            {"name": "up.location.change", "data": {"latitude": 50, "longitude": 14}, "id": 7}
        )
        assert (await phone.answer("7"))["name"] == "up.ack"
        reading = f.up.get_module(UpLocationProvider).reading
        assert (reading.source, reading.value.latitude_deg) == ("android", 50.0)
        assert shown(f) == (True, None)
        await phone.close()
        await until(lambda: not f.provider.connected)
        assert f.heard == [
            LinkStateCommand("android", True),
            LinkStateCommand("android", False),
        ]


FORBIDDEN = {
    "up.system.stop": {},
    "up.arm": {},
    "up.disarm": {},
    "up.panic": {"panic": True, "delay_ms": 1000},
    "load_guard.panic": {"panic": True, "delay_ms": 1000},
    "arduino.pids.tunings": {"pids": {"ratePIDs": {}, "stabPIDs": {}}},
    "up.telemetry.update": {"content": {}, "beacon": 1},
    "up.telemetry.frequency": {"frequency": 20},
    "up.flight_mode.set": {"mode": "FBW"},
    "up.heading.change": {"heading": 5, "mode": "required"},
    "up.link.state": {"link": "arduino", "connected": True},
    "android.speak": {"text": "hello"},
    "android.battery.low": {"level": 1, "low": True},
}


async def test_the_phone_is_a_sensor_whatever_it_says(tmp_path):
    async with Flight(tmp_path) as f:
        phone = await f.phone()
        await until(lambda: f.provider.connected)
        f.listen_to(
            SystemStopCommand, ArmCommand, PanicCommand, PIDTuningsCommand, LinkStateCommand
        )
        for name, data in FORBIDDEN.items():
            phone.say({"name": name, "data": data, "id": name, "role": "admin"})
        for name in FORBIDDEN:
            answer = await phone.answer(name)
            assert answer["name"] == "up.nack"
            assert answer["data"]["code"] in ("forbidden", "invalid"), answer
        assert phone.answer_to("up.system.stop")["data"]["code"] == "forbidden"
        assert phone.answer_to("up.arm")["data"]["code"] == "forbidden"
        assert f.heard == []


HOSTILE = [
    b"\x00\xff\xfe garbage\n",
    b"[" * 10000 + b"\n",
    b'{"name": ' + b'{"a":' * 2000 + b"\n",
    b'{"name": "up.location.update", "data": {"latitude": NaN, "longitude": 1}, "id": "h"}\n',
    b'{"name": "up.location.update", "data": {"latitude": 1e999, "longitude": 1}}\n',
    b'{"name": "up.location.update", "data": {"latitude": 91, "longitude": 1}}\n',
    b'{"name": "up.location.update", "data": [1, 2]}\n',
    b'{"name": "up.location.update", "data": null}\n',
    b'{"name": 5}\n',
    b'{"name": "android.battery", "data": {"level": true}}\n',
    b'{"name": "android.battery", "data": {"level": "full"}}\n',
    b'{"name": "android.battery", "data": {"level": 1}, "id": "\\ud800"}\n',
    b"x" * 20000 + b"\n",
    b"\n\r\n\n",
]


async def test_hostile_lines_are_counted_and_harm_nothing(tmp_path):
    async with Flight(tmp_path) as f:
        f.listen_to(LocationCommand)
        phone = await f.phone()
        phone.say(*HOSTILE, battery(66, id="end"))
        assert (await phone.answer("end"))["name"] == "up.ack"
        assert phone.answer_to("h")["data"]["code"] == "malformed"
        assert f.heard == []
        counters = f.up.command_receiver.counters
        assert counters["malformed"] + counters["invalid"] == 12
        await phone.close()
        await until(lambda: f.telemetry["counters"]["android"]["too_long"] == 1)


async def test_datagrams_do_what_lines_do(tmp_path):
    async with Flight(tmp_path) as f:
        phone = UdpPeer(reactor)
        f.peers.append(phone)
        phone.say(battery(31, id="u"), f.up.ports["general"])
        await until(lambda: [m for m in phone.messages if m["name"] == "up.ack"])
        assert shown(f) == (True, 31)
        phone.say(b'{"name": "android.battery", "data": {"le', f.up.ports["general"])
        phone.say(b'vel": 5}}', f.up.ports["general"])
        await until(lambda: f.up.command_receiver.counters["malformed"] == 2)
        assert f.telemetry["android"]["batteryLevel"] == 31
        await until(lambda: [m for m in phone.messages if m["name"] == "up.telemetry.update"])


async def test_black_box_mode_has_no_datagrams(tmp_path):
    async with Flight(tmp_path, mode=Mode.BLACK_BOX) as f:
        for port in f.up.ports.values():
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
                free.bind(("127.0.0.1", port))
        assert (await f.phone()).is_open


@pytest.mark.parametrize("name", ["general port", "orientation port"])
@pytest.mark.parametrize("kind", [socket.SOCK_STREAM, socket.SOCK_DGRAM])
async def test_a_port_in_use_is_a_failed_start_that_names_port_and_key(tmp_path, name, kind):
    with socket.socket(socket.AF_INET, kind) as taken:
        taken.bind(("127.0.0.1", 0))
        if kind == socket.SOCK_STREAM:
            taken.listen()
        number = taken.getsockname()[1]
        other = {"general port": "orientation port", "orientation port": "general port"}[name]
        text = f"{name}: {number}\n{other}: 0\naddress: 127.0.0.1\n"
        f = Flight(tmp_path, ports=text)
        with pytest.raises(BootStoppedError):
            async with f:
                pass
        (reason,) = f.up.vetoes.own.values()
        assert f"port {number} " in reason
        assert f"(android.yml: {name})" in reason


async def test_a_public_address_is_no_address_to_listen_on(tmp_path):
    f = Flight(tmp_path, ports="address: 203.0.113.4\n")
    with pytest.raises(BootStoppedError):
        async with f:
            pass
    (reason,) = f.up.vetoes.own.values()
    assert "203.0.113.4 is public" in reason
    assert "android.yml: i_accept_plain: true" in reason


async def test_a_public_peer_is_not_heard_on_a_wildcard_address(tmp_path, monkeypatch):
    """The loopback address stands for a public one: its permission is taken away."""
    async with Flight(tmp_path) as f:
        monkeypatch.setattr("up.system.peer_filter.is_private", lambda host: False)
        phone, gyro = await f.phone(), await f.gyro()
        await phone.closed
        await gyro.closed
        stranger = UdpPeer(reactor)
        f.peers.append(stranger)
        stranger.say(battery(3), f.up.ports["general"])
        stranger.say(b"\0" * 24, f.up.ports["orientation"])
        await until(lambda: f.telemetry["counters"]["android"]["refused_peers"] == 4)
        assert shown(f) == (False, None)
        assert f.telemetry["counters"]["android"]["orientation_frames"] == 0


async def test_telemetry_that_json_cannot_hold_is_said_and_flies_on(tmp_path):
    async with Flight(tmp_path) as f:
        phone = await f.phone()
        await until(lambda: f.provider.connected)
        huge = TelemetryCommand({"x": "y" * 20000}, 1)
        f.up.command_executor.execute_command(huge)
        assert f.up.command_executor.counters["failed_handlers"] == 0
        await until(lambda: phone.named("up.telemetry.update"))
        assert all(len(json.dumps(m)) < 16384 for m in phone.messages)


async def test_a_phone_that_comes_and_goes_does_not_fill_the_log(tmp_path):
    async with Flight(tmp_path) as f:
        said = []
        globalLogPublisher.addObserver(said.append)
        try:
            for _ in range(20):
                phone = await f.phone()
                await until(lambda: f.provider.connected)
                await phone.close()
                await until(lambda: not f.provider.connected)
        finally:
            globalLogPublisher.removeObserver(said.append)
        texts = [event.get("log_format") or "" for event in said]
        assert sum("phone" in text for text in texts) == 2


async def test_ipv6_and_ipv4_on_one_port(tmp_path):
    if not socket.has_dualstack_ipv6():
        unavailable("no IPv6")
    ports = "general port: 0\norientation port: 0\naddress: '::'\n"
    async with Flight(tmp_path, ports=ports) as f:
        for number, host in enumerate(("127.0.0.1", "::1")):
            phone = await connect(reactor, f.up.ports["general"], host)
            f.peers.append(phone)
            phone.say(battery(10 + number, id=f"t{number}"))
            await phone.answer(f"t{number}")
            await phone.close()
            await until(lambda: not f.provider.connected)
            stranger = UdpPeer(reactor, host)
            f.peers.append(stranger)
            stranger.say(battery(20 + number), f.up.ports["general"], host)
            await until(lambda n=number: f.telemetry["android"]["batteryLevel"] == 20 + n)
            await until(lambda: not f.provider.connected)
        assert f.telemetry["counters"]["android"]["refused_peers"] == 0
