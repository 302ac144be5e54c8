"""What a MAVSDK program does, on one aircraft: each outcome is a line of JSON.

``mavsdk_script.py URL DESCRIPTOR``: they go to the descriptor, as the library logs on stdout and
stderr. The pilot moves the sticks at each step ``pilot``.
"""

import json
import os
import sys
import time

from mavsdk import ComponentType, Configuration, Mavsdk, MavsdkError
from mavsdk.plugins.action import Action
from mavsdk.plugins.geofence import Circle, FenceType, Geofence, GeofenceData, Point, Polygon
from mavsdk.plugins.mission import Mission, MissionItem, MissionPlan
from mavsdk.plugins.param import Param
from mavsdk.plugins.telemetry import Telemetry

ITEMS = 20
LIMIT_S = 20.0
NAN = float("nan")


def tell(name, outcome):
    os.write(int(sys.argv[2]), json.dumps({"step": name, "outcome": outcome}).encode() + b"\n")


def step(name, call, *given):
    begun_s = time.monotonic()
    try:
        value = call(*given)
        outcome = value if isinstance(value, (int, float, list)) else "done"
        outcome = getattr(outcome, "name", outcome)
    except MavsdkError as error:
        value, outcome = None, error.args[0].name
    tell(name, outcome)
    tell(f"{name} ms", round((time.monotonic() - begun_s) * 1000))
    return value


def until(name, condition):
    end_s = time.monotonic() + LIMIT_S
    while not (value := condition()):
        if time.monotonic() > end_s:
            break
        time.sleep(0.02)
    tell(name, bool(value))
    return value


def ask_pilot(what):
    """Wait until the pilot has done it."""
    tell("pilot", what)
    sys.stdin.readline()


def main(url):
    begun_s = time.monotonic()
    library = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
    library.add_any_connection(url)
    system = library.first_autopilot(LIMIT_S)
    tell("connect ms", round((time.monotonic() - begun_s) * 1000))
    action, mission, fence = Action(system), Mission(system), Geofence(system)
    param, telemetry = Param(system), Telemetry(system)
    texts = []
    telemetry.subscribe_status_text(lambda text, *_: texts.append(text.text))

    def mode():
        return telemetry.flight_mode().name

    until("global position", lambda: telemetry.health().is_global_position_ok)
    until("home", lambda: telemetry.health().is_home_position_ok)
    until("battery", lambda: telemetry.battery().voltage_v > 10)
    until("in air", telemetry.in_air)
    until("fix", lambda: telemetry.gps_info().num_satellites > 5)
    until("airspeed", lambda: telemetry.fixedwing_metrics().airspeed_m_s > 3)
    until("receiver", lambda: telemetry.rc_status().is_available)
    until("unix time", lambda: telemetry.unix_epoch_time() > 1e15)
    step("hold", action.hold)
    until("is holding", lambda: mode() == "HOLD")

    tell("parameters", len(param.get_all_params().float_params))
    step("set", param.set_param_float, "STAB_RLL_P", 3.25)
    step("read", param.get_param_float, "STAB_RLL_P")
    step("unknown", param.get_param_float, "NO_SUCH")
    step("read only", param.set_param_float, "SYSID_THISMAV", 9.0)
    step("out of range", param.set_param_float, "STAB_RLL_P", 99.0)
    step("after", param.get_param_float, "STAB_RLL_P")

    here = telemetry.position()
    latitude, longitude = here.latitude_deg, here.longitude_deg
    items = [
        MissionItem(
            latitude + 0.002 * (1 + each % 3), longitude + 0.003 * (each % 2), 90.0,
            12.0 if each < 3 else None, True,
        )
        for each in range(ITEMS)
    ]  # fmt: skip
    step("upload", mission.upload_mission, MissionPlan(items))
    back = step("download", mission.download_mission).mission_items

    def is_equal(one, other):
        north, east = one.latitude_deg - other.latitude_deg, one.longitude_deg - other.longitude_deg
        height = one.relative_altitude_m - other.relative_altitude_m
        return max(map(abs, (north, east, height))) < 1e-6

    is_whole = len(back) == len(items)
    tell("equal", is_whole and all(map(is_equal, back, items)))
    tell("speeds", [each.speed_m_s for each in back[:3]])
    step("start", mission.start_mission)
    until("is in mission", lambda: mode() == "MISSION")
    step("item", mission.set_current_mission_item, 4)
    until("is at item", lambda: mission.mission_progress().current == 4)
    tell("total", mission.mission_progress().total)
    step("pause", mission.pause_mission)
    until("is paused", lambda: mode() == "HOLD")

    corners = ((-0.02, -0.02), (-0.02, 0.02), (0.02, 0.02), (0.02, -0.02))
    borders = GeofenceData()
    around = [Point(latitude + north, longitude + east) for north, east in corners]
    borders.polygons = [Polygon(around, FenceType.INCLUSION)]
    beside = Point(latitude + 0.012, longitude + 0.012)
    borders.circles = [Circle(beside, 50.0, FenceType.EXCLUSION)]
    step("fence", fence.upload_geofence, borders)
    read = step("fence back", fence.download_geofence)
    tell("borders", [len(read.polygons[0].points), read.circles[0].radius])
    step("fence clear", fence.clear_geofence)

    altitude = here.absolute_altitude_m + 20
    step("goto", action.goto_location, latitude + 0.001, longitude + 0.001, altitude, NAN)
    until("is guided", lambda: mode() not in ("HOLD", "MISSION"))
    step("too far", action.goto_location, latitude + 2, longitude, altitude, NAN)
    step("return", action.return_to_launch)
    until("is returning", lambda: mode() == "RETURN_TO_LAUNCH")
    step("clear", mission.clear_mission)

    # A forced disarming.
    step("kill", action.kill)
    # The switch leaves AUTO.
    ask_pilot("stick")
    until("by sticks", lambda: mode() not in ("HOLD", "RETURN_TO_LAUNCH"))
    step("not at AUTO", action.hold)
    ask_pilot("auto")
    ask_pilot("low")
    until("disarm", lambda: _is_done(action.disarm))
    until("is disarmed", lambda: not telemetry.armed())
    ask_pilot("high")
    until("is not armable", lambda: not telemetry.health().is_armable)
    step("arm refused", action.arm)
    ask_pilot("low")
    until("is armable", lambda: telemetry.health().is_armable)
    step("arm", action.arm)
    until("is armed", telemetry.armed)
    tell("texts", texts)


def _is_done(call):
    try:
        call()
    except MavsdkError:
        return False
    return True


if __name__ == "__main__":
    main(sys.argv[1])
