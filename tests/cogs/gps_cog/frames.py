"""What receivers send: recordings of a simulated flight."""

import math

from pynmeagps.nmeahelpers import calc_checksum

from up_simulator.aircraft.flight import FlightState
from up_simulator.sensors.ubx_receiver import UbxReceiver

RADIUS_M, SPEED_M_S, RATE_HZ = 60.0, 12.0, 10
LATITUDE_DEG, LONGITUDE_DEG, ALTITUDE_M = 50.0, 14.5, 300.0
METRES_PER_DEG = 111_320.0


def state_at(time_s):
    """Return the truth of a circle to the right, climbing."""
    angle = SPEED_M_S * time_s / RADIUS_M
    north_m, east_m = RADIUS_M * math.sin(angle), RADIUS_M * (1 - math.cos(angle))
    east_deg = east_m / METRES_PER_DEG / math.cos(math.radians(LATITUDE_DEG))
    course_deg = math.degrees(angle) % 360.0
    return FlightState(
        time_s, 20.0, 2.0, course_deg, 0.0, 0.0, 11.5,
        LATITUDE_DEG + north_m / METRES_PER_DEG, LONGITUDE_DEG + east_deg,
        ALTITUDE_M + 0.5 * time_s, 100.0 + 0.5 * time_s, SPEED_M_S, course_deg, SPEED_M_S,
        climb_m_s=0.5, north_m=north_m, east_m=east_m,
    )  # fmt: skip


def ubx_recording(seconds, **given):
    """Return (time, bytes) of a receiver that is set up, from its first fix on."""
    receiver = UbxReceiver(is_exact=True, **given)
    receiver.is_set_up, receiver.period_s = True, 1 / RATE_HZ
    receiver._use_period()
    times = [step / 100 for step in range(round(seconds * 100))]
    said = [(time_s, receiver.poll(state_at(time_s))) for time_s in times]
    return [each for each in said if each[1]][1:]


def sentence(content):
    """Return an NMEA sentence with its checksum."""
    return f"${content}*{calc_checksum(content)}\r\n".encode()


def nmea_epoch(time_s, *, quality=1, status="A", mode="A", accuracy=True):
    """Return the sentences of one fix."""
    state = state_at(time_s)
    clock = 36_000.0 + time_s
    at = f"{int(clock // 3600):02}{int(clock // 60 % 60):02}{clock % 60:05.2f}"
    lat, lon = _degrees(state.latitude_deg, 2) + ",N", _degrees(state.longitude_deg, 3) + ",E"
    place = f"{lat},{lon}" if quality else ",,,"
    knots = state.speed_m_s * 3600 / 1852
    said = [
        f"GNRMC,{at},{status},{place},{knots:.3f},{state.track_deg:.2f},241126,,,{mode}",
        f"GNGGA,{at},{place},{quality},11,0.8,{state.altitude_m:.1f},M,44.0,M,,",
        "GNGSA,A,3,01,02,03,04,05,06,07,08,09,10,11,,1.4,0.8,1.1",
        *([f"GNGST,{at},1.1,,,,0.6,0.8,1.5"] if accuracy else []),
    ]
    return b"".join(map(sentence, said))


def _degrees(value, width):
    whole = int(value)
    return f"{whole:0{width}}{(value - whole) * 60:08.5f}"
