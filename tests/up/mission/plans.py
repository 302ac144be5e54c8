"""Random missions and fences, and files as public ground stations write them, rebuilt here.

The files that were read for them:

* a mission of MAVSDK's tests, written by QGroundControl for a multicopter: TAKEOFF, waypoints, one
  IMAGE_START_CAPTURE between them, RETURN_TO_LAUNCH in frame 2, yaw parameters null, a home with 15
  digits;
* a survey of the same tests: SET_CAMERA_MODE with null parameters, then one ComplexItem whose
  TransectStyleComplexItem has waypoints and DO_SET_CAM_TRIGG_DIST as Items;
* a plan by another program there: keys in lower case, one DO_DIGICAM_CONTROL, home 0, 0, 0;
* fences of a QGroundControl for one company: an empty mission, an inclusion polygon and an
  exclusion polygon that share corners;
* waypoint files of ArduPilot's autotest for aeroplanes: the main flight (home, waypoints in frame
  3, DO_CHANGE_SPEED with zeros, LAND), one with DO_JUMP to row 2, and one with every kind of item:
  comments, acceptance radius, pass-by, loiters of both directions, LOITER_TO_ALT, a loiter at 0, 0,
  NAV_ARC_WAYPOINT, JUMP_TAG, DO_LAND_START.
"""

from hypothesis import strategies as st

from up.mission.items import Border, MissionItem

_LATITUDES = st.floats(-90, 90).filter(bool)
_LONGITUDES = st.floats(-180, 180)
_HEIGHT = {"altitude_m": st.floats(-1000, 9000), "is_above_sea": st.booleans()}
_PLACE = {"latitude_deg": _LATITUDES, "longitude_deg": _LONGITUDES, **_HEIGHT}
_CIRCLE = {
    **_PLACE,
    "radius_m": st.none() | st.floats(10, 1000),
    "is_clockwise": st.booleans(),
}
_FIELDS = {
    "takeoff": _HEIGHT,
    "waypoint": {**_PLACE, "is_over": st.booleans()},
    "loiter": _CIRCLE,
    "loiter_turns": {**_CIRCLE, "turns": st.floats(0.1, 1000)},
    "loiter_time": {**_CIRCLE, "time_s": st.floats(0, 86400)},
    "return": {},
    "land": _PLACE,
    "speed": {"airspeed_m_s": st.floats(3, 60)},
    "jump": {"item": st.just(1), "repeat": st.integers(-1, 1000)},
}
MISSIONS = st.lists(
    st.one_of(
        st.builds(MissionItem, kind=st.just(kind), **fields) for kind, fields in _FIELDS.items()
    ),
    max_size=8,
).map(tuple)
_PAIRS = st.tuples(_LATITUDES, _LONGITUDES)
POLYGONS = st.builds(
    Border,
    is_inside=st.booleans(),
    corners=st.lists(_PAIRS, min_size=3, max_size=6).map(tuple),
)
CIRCLES = st.builds(
    Border,
    is_inside=st.booleans(),
    latitude_deg=_LATITUDES,
    longitude_deg=_LONGITUDES,
    radius_m=st.floats(30, 100_000),
)
FENCES = st.tuples(st.lists(POLYGONS, max_size=3), st.lists(CIRCLES, max_size=3)).map(
    lambda pair: (*pair[0], *pair[1])
)
HOMES = st.none() | st.tuples(_LATITUDES, _LONGITUDES, st.floats(-400, 9000))


def simple(number, command, *params, frame=3, **more):
    """Return an item as QGroundControl writes it; missing parameters are 0."""
    return {
        "autoContinue": True,
        "command": command,
        "doJumpId": number,
        "frame": frame,
        "params": [*params, *[0] * (7 - len(params))],
        "type": "SimpleItem",
        **more,
    }


def waypoint(number, latitude=50.08, longitude=14.43, altitude=60, **more):
    return simple(number, 16, 0, 0, 0, None, latitude, longitude, altitude, **more)


def survey(first):
    """Return two lines over a field, with the trigger of the camera at the ends of each."""
    camera = [simple(first + each, 206, 25, 0, 1, frame=2) for each in (1, 3)]
    ends = [waypoint(first + 2 * each, 50.08, 14.43 + each / 1000) for each in range(3)]
    inner = [ends[0], camera[0], ends[1], camera[1], ends[2]]
    return {
        "TransectStyleComplexItem": {"CameraShots": 6, "Items": inner, "version": 2},
        "complexItemType": "survey",
        "polygon": [[50.08, 14.43], [50.08, 14.44], [50.09, 14.44]],
        "type": "ComplexItem",
        "version": 5,
    }


def document(*items, polygons=(), circles=(), **mission):
    """Return a plan as QGroundControl writes it."""
    return {
        "fileType": "Plan",
        "geoFence": {"circles": [*circles], "polygons": [*polygons], "version": 2},
        "groundStation": "QGroundControl",
        "mission": {
            "cruiseSpeed": 15,
            "firmwareType": 12,
            "globalPlanAltitudeMode": 1,
            "hoverSpeed": 5,
            "items": [*items],
            "plannedHomePosition": [50.07812345678901, 14.42, 231.5],
            "vehicleType": 1,
            "version": 2,
            **mission,
        },
        "rallyPoints": {"points": [], "version": 2},
        "version": 1,
    }


def row(number, command, *params, frame=3):
    """Return a row as Mission Planner writes it."""
    values = [*params, *[0.0] * (7 - len(params))]
    return "\t".join(
        [str(number), "0", str(frame), str(command), *map("{:.8f}".format, values), "1"]
    )


HOME_ROW = row(0, 16, 0, 0, 0, 0, 50.078, 14.42, 231.5, frame=0)


def rows(*lines):
    return "\r\n".join(["QGC WPL 110", HOME_ROW, *lines, ""])
