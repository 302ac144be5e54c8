import subprocess
import sys


def test_a_log_is_read_and_written_without_twisted():
    """The ground's replay, the simulator and scripts of the user do not need it for that."""
    code = (
        "import importlib, pkgutil, sys, up.flight_log, up_flightlog.findings, up_flightlog.read\n"
        "for package in (up.flight_log, up_flightlog.read, up_flightlog.findings):\n"
        "    for info in pkgutil.iter_modules(package.__path__):\n"
        "        importlib.import_module(f'{package.__name__}.{info.name}')\n"
        "print(sorted({name.partition('.')[0] for name in sys.modules} & {'twisted', 'yaml'}))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
