import subprocess
import sys


def test_a_log_is_read_and_written_without_twisted():
    # The ground's replay, the simulator and scripts of the user read logs; none of them needs it.
    code = (
        "import importlib, pkgutil, sys, up.flight_log as package\n"
        "for info in pkgutil.iter_modules(package.__path__):\n"
        "    importlib.import_module(f'up.flight_log.{info.name}')\n"
        "print(sorted({name.partition('.')[0] for name in sys.modules} & {'twisted', 'yaml'}))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
