"""The packets of Betaflight's SITL (``target.h`` of its simulator), in its frames."""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence

from up_rig.imu import Motion
from up_simulator.aircraft.flight import FlightState, Servos
from up_simulator.radio.sticks import Sticks

PWM_PORT, STATE_PORT, RECEIVER_PORT, MSP_PORT = 9001, 9003, 9004, 5761
LINE = f"tcp:127.0.0.1:{MSP_PORT}"
"""Its first UART: what msp.yml has as ``port``."""
PWM_SIZE = 68
_STATE, _RECEIVER, _PWM = struct.Struct("<18d"), struct.Struct("<d16H"), struct.Struct("<H2x16f")
_TIME_S = 1.0
"""Growing times would let the board set its clock by each pair of packets: it would run away."""
_HALF_SQRT = math.sqrt(0.5)
_CENTRE_US = 1500


def pack_state(motion: Motion, state: FlightState, first: FlightState) -> bytes:
    """Return ``fdm_packet``; SITL mirrors positions about the ``first`` that it got."""
    east = math.radians(state.track_deg)
    return _STATE.pack(
        _TIME_S,
        math.radians(motion.roll_rate_deg_s),
        math.radians(motion.pitch_rate_deg_s),
        -math.radians(motion.yaw_rate_deg_s),
        -motion.force_x_m_s2,
        motion.force_y_m_s2,
        motion.force_z_m_s2,
        *_quaternion(state),
        state.speed_m_s * math.sin(east),
        state.speed_m_s * math.cos(east),
        state.climb_m_s,
        2 * first.longitude_deg - state.longitude_deg,
        2 * first.latitude_deg - state.latitude_deg,
        state.altitude_m,
        0.0,
    )


def pack_sticks(sticks: Sticks) -> bytes:
    """Return ``rc_packet``: ailerons, elevator (down above 1500), throttle, rudder, AUX1, AUX2."""
    return _RECEIVER.pack(
        _TIME_S,
        sticks.ailerons,
        2 * _CENTRE_US - sticks.elevator,
        sticks.throttle,
        sticks.rudder,
        sticks.aux1,
        sticks.aux2,
        *[1000] * 10,
    )


def read_servos(packet: bytes) -> Servos:
    """Return the pulses of the mixer AIRPLANE from ``servo_packet_raw``."""
    _, *outputs = _PWM.unpack(packet)
    motor, ailerons, rudder, elevator = (_pulse(outputs[at]) for at in (0, 2, 4, 5))
    return ailerons, 2 * _CENTRE_US - elevator, motor, 2 * _CENTRE_US - rudder


def _pulse(value: float) -> int:
    return round(min(2000.0, max(1000.0, value)))


def _quaternion(state: FlightState) -> Sequence[float]:
    """Return the attitude in the frame of Gazebo's plug-in, from which SITL turns it back."""
    angles_deg = (state.roll_deg, state.pitch_deg, state.yaw_deg)
    halves = [math.radians(each) / 2 for each in angles_deg]
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(half), math.sin(half)) for half in halves)
    # From the body's axes forward, left, up to north, west, up.
    w = cr * cp * cy + sr * sp * sy
    x = sr * cp * cy - cr * sp * sy
    y = -(cr * sp * cy + sr * cp * sy)
    z = -(cr * cp * sy - sr * sp * cy)
    return (
        _HALF_SQRT * (w + z),
        _HALF_SQRT * (x + y),
        -_HALF_SQRT * (y - x),
        -_HALF_SQRT * (z - w),
    )
