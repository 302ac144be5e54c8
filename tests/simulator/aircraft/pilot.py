"""A pilot for the flight tests of an airframe: sticks in us from neutral, the mix as aboard."""

import math
from dataclasses import dataclass

from up_simulator.aircraft import FlightDynamics, Start, load_airframe

TICK_S = 0.02


def launched(name, model="auto", **start):
    values = {"height_m": 600.0, **start}
    return FlightDynamics(load_airframe(name), Start(**values), model=model)


def move(flight, ailerons=0.0, elevator=0.0, throttle_us=1000.0, rudder=0.0):
    if flight.airframe.profile["mix"] == "elevon":
        left, right = elevator - ailerons, elevator + ailerons
        flight.set_servos((1500 + left, 1500 + right, throttle_us, 1500 + rudder))
    else:
        flight.set_servos((1500 + ailerons, 1500 + elevator, throttle_us, 1500 + rudder))


def wings_level(state):
    return max(-400.0, min(400.0, -4.0 * state.roll_deg - 2.0 * state.roll_rate_deg_s))


def hold_pitch(state, pitch_deg):
    return max(-500.0, min(500.0, 25 * (pitch_deg - state.pitch_deg) - 3 * state.pitch_rate_deg_s))


def fly(flight, seconds, **sticks):
    """Fly hands off in roll with these sticks and return the states at 50 Hz."""
    states = []
    for _ in range(round(seconds / TICK_S)):
        move(flight, wings_level(flight.state), **sticks)
        flight.advance(TICK_S)
        states.append(flight.state)
    return states


@dataclass(frozen=True)
class Glide:
    """A steady glide at one position of the elevator."""

    elevator_us: float
    airspeed_m_s: float
    sink_m_s: float
    ratio: float


def glide(name, elevator_us, seconds=36.0, model="auto"):
    """Go there slowly, settle, and take the mean of the last third."""
    flight = launched(name, model)
    for tick in range(300):
        move(flight, wings_level(flight.state), elevator_us * tick / 300)
        flight.advance(TICK_S)
    states = fly(flight, seconds, elevator=elevator_us)
    last = states[-len(states) // 3 :]
    airspeed = sum(each.airspeed_m_s for each in last) / len(last)
    sink = -sum(each.climb_m_s for each in last) / len(last)
    return Glide(elevator_us, airspeed, sink, math.sqrt(airspeed**2 - sink**2) / sink)


def stall(name, model="auto"):
    """Pull slowly with level wings until the lift breaks: the slowest at about 1 g until then."""
    flight = launched(name, model)
    slowest, elevator = 99.0, 0.0
    for _ in range(3000):
        state = flight.state
        elevator += TICK_S * 8
        move(flight, wings_level(state), min(500.0, elevator))
        flight.advance(TICK_S)
        if state.alpha_deg > 7.0 and abs(state.load_factor_g - 1) < 0.05:
            slowest = min(slowest, state.airspeed_m_s)
        if state.alpha_deg > 7.0 and state.load_factor_g < 0.8:
            break
    return slowest


def peaks(values):
    return [
        (index, values[index])
        for index in range(1, len(values) - 1)
        if values[index - 1] < values[index] >= values[index + 1]
    ]
