"""An aircraft of a test: sends its input to a proxy, and answers every Command.

Arguments: the proxy's airborne port, its hello. Reads JSON lines: ``{"data": {...}}`` is its
telemetry from then on (deeply merged with that of the ground station's tests unless ``"whole"`` is
true), ``{"nack": "reason"}`` refuses Commands with that reason from then on, ``{"plans": [latitude,
longitude, altitude]}`` keeps plans from then on, with home there. Ends with its input.
"""

import json
import sys
import tempfile
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
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
        Aircraft(int(port), answers, hello=hello.encode() + b"\n") as aircraft,
    ):
        print("speaks", flush=True)
        for line in sys.stdin:
            told = json.loads(line)
            if "data" in told:
                aircraft.data = told["data"] if told.get("whole") else {**frame(), **told["data"]}
            if "plans" in told:
                keep_plans(aircraft, answers, folder, told["plans"])
            if "nack" in told:
                for name in COMMANDS:
                    answers[name] = refusal(told["nack"])


def keep_plans(aircraft, answers, folder, home):
    # Only a test that needs it waits for the import.
    from tests.browser.support.plans import Plans

    plans = Plans(folder, home)

    def shown(answer):
        def answered(message):
            said = answer(message)
            aircraft.data = {**aircraft.data, **plans.telemetry}
            return said

        return answered

    answers.update({name: shown(answer) for name, answer in plans.answers.items()})
    aircraft.data = {**aircraft.data, **plans.telemetry}


def refusal(reason):
    return lambda message: [
        ("up.nack", {"id": message["id"], "code": "refused", "reason": reason}),
    ]


main(*sys.argv[1:])
