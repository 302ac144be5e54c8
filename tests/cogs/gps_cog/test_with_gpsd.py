"""The real gpsd, fed by gpsfake with recordings of a simulated flight."""

import os
import shutil
import signal
import socket
import subprocess

import pytest
from gps_cog.modules.gps_provider import GpsProvider

from tests.cogs.gps_cog.frames import (
    ALTITUDE_M,
    LATITUDE_DEG,
    METRES_PER_DEG,
    RADIUS_M,
    SPEED_M_S,
    nmea_epoch,
    ubx_recording,
)
from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.system import build_up
from tests.support.tools import need_tool, unavailable
from up.commands.location_command import LocationCommand
from up.life_cycle import LifeCycle
from up.providers.up_location_provider import UpLocationProvider

PATH = os.pathsep.join([os.environ["PATH"], "/usr/sbin", "/usr/local/sbin"])
COLD_S, FLIGHT_S, STEP_S = 0.5, 4.0, 0.1
NOISE = b"$GNGGA,no checksum\r\n$GNRMC,1,V*00\r\n\xb5b\x01\x07\x5c\x00cut"


def recording(kind):
    """Return a cold start, noise, and a flight."""
    steps = range(1, round(FLIGHT_S / STEP_S))
    if kind == "ubx":
        cold = [data for _, data in ubx_recording(COLD_S, cold_s=9.0)]
        return b"".join([*cold, NOISE, *(data for _, data in ubx_recording(FLIGHT_S))])
    cold = [nmea_epoch(step * STEP_S - 5, quality=0, status="V") for step in range(5)]
    return b"".join([*cold, NOISE, *(nmea_epoch(step * STEP_S) for step in steps)])


class Gpsfake:
    """gpsfake replays a file again and again, about as fast as it was recorded."""

    def __init__(self, file, port, pieces_s):
        command = ["gpsfake", "-q", "-n", "-P", str(port), "-c", str(pieces_s), str(file)]
        self._process = subprocess.Popen(
            command, env=os.environ | {"PATH": PATH}, start_new_session=True,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip

    def end(self):
        os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()


@pytest.mark.parametrize(("kind", "pieces_s"), [("nmea", 0.02), ("ubx", 0.08)])
def test_the_fixes_of_gpsd_are_published_and_again_after_its_restart(tmp_path, kind, pieces_s):
    need_tool("gpsfake", "gpsd-clients")
    if shutil.which("gpsd", path=PATH) is None:
        unavailable("gpsd is not installed (Debian package gpsd)")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    file = tmp_path / f"flight.{kind}"
    file.write_bytes(recording(kind))
    config = {"gps.yml": f"receivers: {{sky: {{source: gpsd, gpsd_port: {port}}}}}\n"}

    async def fly():
        up = build_up([GpsProvider], reactor, tmp_path / "config", config=config)
        heard = []
        up.command_executor.register_command(LocationCommand, heard.append)
        life = LifeCycle(up)
        await life.start()
        daemon = Gpsfake(file, port, pieces_s)
        try:
            await until(lambda: len(heard) >= 12, what="fixes of gpsd")
            daemon.end()
            count = len(heard)
            daemon = Gpsfake(file, port, pieces_s)
            await until(lambda: len(heard) >= count + 3, what="fixes of the gpsd after it")
            content = up.telemetry_controller.collect()
        finally:
            daemon.end()
            await life.stop()
        return heard, content, up.get_module(UpLocationProvider).reading.source

    heard, content, source = run_in_reactor(fly)
    assert source == "sky"
    assert content["counters"]["gps_sky"]["fixes"] >= 12
    for each in heard:
        north_m = (each.latitude_deg - LATITUDE_DEG) * METRES_PER_DEG
        assert abs(north_m) <= RADIUS_M
        assert each.speed_m_s == pytest.approx(SPEED_M_S, abs=0.1)
        assert ALTITUDE_M - 1 <= each.altitude_m <= ALTITUDE_M + FLIGHT_S
        assert each.fix == "3d" and each.accuracy_m <= 10.0
        assert 100 <= each.age_ms <= 2000
    # The circle begins northward and turns right: latitude and course agree.
    assert max(each.bearing_deg for each in heard) > 10
