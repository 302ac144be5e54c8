"""Runs Raspilot and notes, by Python's audit events, which thread touched the flights' folder.

``python -m tests...daemon CONFIG FLIGHTS NOTES``
"""

import sys
import threading
from pathlib import Path

from raspilot.main import main

EVENTS = ("open", "os.", "shutil.", "fcntl.flock", "glob.")


def watch(flights, notes):
    """Write a line for each event that names something in the folder."""
    inside = threading.local()

    def note(event, arguments):
        if not event.startswith(EVENTS) or getattr(inside, "noting", False):
            return
        if any(str(each).startswith(flights) for each in arguments):
            inside.noting = True
            with Path(notes).open("a") as stream:
                stream.write(f"{event} {threading.current_thread().name}\n")
            inside.noting = False

    sys.addaudithook(note)


if __name__ == "__main__":
    config, flights, notes = sys.argv[1:]
    watch(flights, notes)
    sys.exit(main(["--config", config], Path(__file__).parents[3]))
