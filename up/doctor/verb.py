"""``up doctor``: examines this machine and prints what to do."""

import argparse
import json
from dataclasses import asdict

from up.cli.option_parser import EXIT_FAILED, EXIT_OK
from up.doctor.checks import examine
from up.doctor.machine import Machine
from up.output import echo


def run(values: argparse.Namespace) -> int:
    """Print the rows; return EXIT_FAILED if one of them is an error."""
    rows = examine(Machine())
    if values.json:
        echo(json.dumps([asdict(each) for each in rows], indent=1))
    else:
        for each in rows:
            echo(f"{each.state:<15} {each.code:<15} {each.text}")
            if each.remedy:
                echo(f"{'':<31} {each.remedy}")
    return EXIT_FAILED if any(each.state == "error" for each in rows) else EXIT_OK
