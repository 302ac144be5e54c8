"""An aircraft of a test: sends its input to a proxy, and answers every Command.

Arguments: the proxy's airborne port, its hello. Reads JSON lines: ``{"data": {...}}`` is its
telemetry from then on (deeply merged with that of the ground station's tests unless ``"whole"`` is
true), ``{"nack": "reason"}`` refuses Commands with that reason from then on. Ends with its input.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[3]))

from tests.ground.aircraft import Aircraft, frame

COMMANDS = (
    "up.flight_mode.set",
    "up.arm",
    "up.disarm",
    "up.heading.change",
    "up.navigation.target",
    "android.speak",
)


def main(port, hello):
    # An empty one would not be kept.
    answers = {"nothing": refusal("")}
    with Aircraft(int(port), answers, hello=hello.encode() + b"\n") as aircraft:
        print("speaks", flush=True)
        for line in sys.stdin:
            told = json.loads(line)
            if "data" in told:
                aircraft.data = told["data"] if told.get("whole") else {**frame(), **told["data"]}
            if "nack" in told:
                for name in COMMANDS:
                    answers[name] = refusal(told["nack"])


def refusal(reason):
    return lambda message: [
        ("up.nack", {"id": message["id"], "code": "refused", "reason": reason}),
    ]


main(*sys.argv[1:])
