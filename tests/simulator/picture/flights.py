"""Flights made up for pictures: a log with everything that can be drawn."""

import math
import random

from up_simulator.scenario.log import FlightLog

COLUMNS = (
    "time_s",
    *(f"truth.{name}" for name in ("roll_deg", "pitch_deg", "roll_rate_deg_s")),
    *(f"truth.{name}" for name in ("height_m", "airspeed_m_s", "load_factor_g")),
    *("truth.north_m", "truth.east_m", "truth.crashed"),
    *(f"stick.{channel}_us" for channel in ("ailerons", "elevator", "throttle", "rudder")),
    *(f"servo.{channel}_us" for channel in ("ailerons", "elevator", "throttle", "rudder")),
    *("board.mode", "board.failsafe", "board.roll_deg", "board.pitch_deg"),
    *("demand.roll_deg", "demand.pitch_deg", "demand.roll_rate_deg_s"),
    *("error.roll_deg", "error.pitch_deg", "event"),
)


def mode_at(time_s):
    for until_s, mode in ((5, "ACRO"), (9, "RATE"), (24, "FBW"), (30, "SETPOINT")):
        if time_s < until_s:
            return mode
    return "FBW"


def made_up(seconds=40.0, *, crashes=False, seed=3):
    dice = random.Random(seed)
    log = FlightLog(COLUMNS)
    roll = rate = east = north = 0.0
    for row in range(round(seconds / 0.02)):
        time = row * 0.02
        mode = mode_at(time)
        wanted = 30.0 if 10 <= time < 16 else -25.0 if 18 <= time < 23 else 0.0
        rate += 0.02 * (25 * (wanted - roll) - 6 * rate)
        roll += 0.02 * rate + dice.gauss(0, 0.03)
        heading = 0.02 * time * roll / 6
        north += 0.24 * math.cos(heading)
        east += 0.24 * math.sin(heading)
        height = 120 - 0.6 * time - (0 if not crashes else 0.065 * time**2)
        crashed = crashes and height <= 0
        log.append(
            {
                "time_s": time,
                "truth.roll_deg": roll,
                "truth.pitch_deg": 3 * math.sin(time / 3),
                "truth.roll_rate_deg_s": rate,
                "truth.height_m": max(0.0, height),
                "truth.airspeed_m_s": 12 + math.sin(time),
                "truth.load_factor_g": 1 / math.cos(math.radians(roll)),
                "truth.north_m": north,
                "truth.east_m": east,
                "truth.crashed": crashed,
                "stick.ailerons_us": 1500 + 10 * wanted,
                "stick.elevator_us": 1510,
                "stick.throttle_us": 1400,
                "stick.rudder_us": 1500,
                "servo.ailerons_us": 1500 + 3 * (wanted - roll),
                "servo.elevator_us": 1500 + 40 * math.sin(time / 3),
                "servo.throttle_us": 1400,
                "servo.rudder_us": 1500 - rate,
                "board.mode": mode,
                "board.failsafe": 32 <= time < 36,
                "board.roll_deg": roll + 1 + 0.5 * math.sin(time / 2),
                "board.pitch_deg": 3 * math.sin(time / 3) - 0.4,
                "demand.roll_deg": None if mode in ("ACRO", "RATE") else wanted,
                "demand.pitch_deg": None if mode in ("ACRO", "RATE") else 0.0,
                "demand.roll_rate_deg_s": 0.0 if mode == "RATE" else None,
                "error.roll_deg": roll - wanted,
                "event": EVENTS.get(row),
            }
        )
        if crashed:
            break
    return log


EVENTS = {
    500: "gust from the left",
    510: "serial line unplugged",
    520: "gains.set from the ground",
    800: "phone unplugged",
    1600: "receiver lost",
    1800: "receiver back; serial line back",
}
