"""Phone in, telemetry out through a real proxy, Commands back: the whole way."""

import struct

import pytest
from android_cog.commands.android_speak_command import AndroidSpeakCommand
from android_cog.modules.android_battery_provider import AndroidBatteryProvider
from android_cog.modules.android_provider import AndroidProvider
from mission_control_cog.modules.mission_control_provider import MissionControlProvider

from tests.cogs.peers import connect
from tests.proxy.program import Program
from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.system import build_up, started

MODULES = (AndroidProvider, AndroidBatteryProvider, MissionControlProvider)


@pytest.fixture
def proxy(tmp_path):
    with Program(tmp_path / "proxy") as program:
        yield program


def config(proxy, role="operator"):
    return {
        "android.yml": "general port: 0\norientation port: 0\naddress: 127.0.0.1\n",
        "mission_control.yml": (
            f"remote_server: {{url: 127.0.0.1, port: {proxy.airborne_port}}}\n"
            f"aircraft: glider\nrole: {role}\n"
        ),
    }


def newest(ground):
    frames = ground.named("up.telemetry.update")
    return frames[-1] if frames else {"data": {}}


def test_phone_to_ground_and_back(proxy, tmp_path):
    async def flight():
        up = build_up(MODULES, reactor, tmp_path / "config", config=config(proxy))
        up.command_executor.registry.add(AndroidSpeakCommand)
        life = await started(up)
        phone = await connect(reactor, up.ports["general"])
        gyro = await connect(reactor, up.ports["orientation"])
        ground = await connect(reactor, proxy.ground_port)
        ground.say(b"UP1 aircraft=glider seat=command\n")
        await until(lambda: b"UP1 ok aircraft=glider seat=command" in ground.received)

        phone.say({"name": "android.battery", "data": {"level": 57}})
        phone.say({"name": "up.location.change", "data": {"latitude": 50.1, "longitude": 14.4}})
        gyro.say(struct.pack(">6f", 1.5, -2.5, 90, 0.1, 0.2, 0.3))
        await until(lambda: newest(ground)["data"].get("orientation", {}).get("yaw") == 90)
        seen = newest(ground)["data"]
        assert seen["android"] == {"connected": True, "competitor": None, "batteryLevel": 57}
        assert (seen["location"]["latitude"], seen["source"]["location"]) == (50.1, "android")
        assert seen["orientation"] == {"roll": 1.5, "pitch": -2.5, "yaw": 90}

        ground.say({"name": "up.telemetry.frequency", "data": {"frequency": 50}, "id": "t1"})
        assert (await ground.answer("t1"))["name"] == "up.ack"
        assert up.telemetry_controller.period_ms == 50

        beacon = newest(ground)["beacon"]
        ground.say(
            {"name": "android.speak", "data": {"text": "turn"}, "id": "s1", "beacon": beacon}
        )
        (asked,) = await until(lambda: phone.named("android.speak"))
        assert asked["data"] == {"text": "turn"}
        assert ground.answer_to("s1") is None
        phone.say({"name": "up.ack", "data": {"id": asked["id"]}})
        assert (await ground.answer("s1"))["name"] == "up.ack"
        assert phone.named("up.telemetry.update")

        ground.say({"name": "up.arm", "data": {}, "id": "a1", "beacon": newest(ground)["beacon"]})
        refused = (await ground.answer("a1"))["data"]
        assert refused["code"] == "forbidden"
        assert "mission_control.yml: role" in refused["reason"]
        for peer in (phone, gyro, ground):
            await peer.close()
        await life.stop()

    run_in_reactor(flight)
