"""Packaging of Up, Raspilot, their servers, the ground station, the simulator and the bench rig.

The cogs are distributions of their own (cogs/*/setup.py); ``up gather`` installs them.
"""

from pathlib import Path

from setuptools import find_packages, setup

ROOT = Path(__file__).parent
SOURCES = {
    "up": ".",
    "raspilot": ".",
    "up_runner": "runner",
    "up_proxy": "proxy",
    "up_ground": "ground",
    "up_simulator": "simulator",
    "up_rig": "arduino/bench",
    "up_mavlink": "mavlink",
}


def version() -> str:
    """Return the version that up/version.py states, without importing the package."""
    scope: dict[str, str] = {}
    exec((ROOT / "up" / "version.py").read_text(encoding="utf-8"), scope)
    return scope["VERSION"]


def packages() -> list[str]:
    """Return every package of every source folder."""
    found: list[str] = []
    for name, folder in SOURCES.items():
        found += find_packages(str(ROOT / folder), include=[name, f"{name}.*"])
    return found


setup(
    name="raspilot",
    version=version(),
    description="Up, a framework for autopilots that can be changed, and Raspilot, the autopilot",
    long_description=(ROOT / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    license="MIT",
    python_requires=">=3.11",
    packages=packages(),
    package_dir={
        name: str(Path(folder, name)) for name, folder in SOURCES.items() if folder != "."
    },
    include_package_data=True,
    package_data={
        "": [
            "*.yml",
            "*.txt",
            "*.tmpl",
            "*.service",
            "*.conf",
            "*.md",
            "UpFile",
            "py.typed",
            "*.csv",
            "*.xml",
            "*.gz",
            "airframes/*/*.yml",
            "scenarios/*.yml",
            "shim/*.[ch]",
        ],
        "up_ground.web": ["static/**/*"],
    },
    install_requires=[
        "twisted>=22.4",
        "pyserial>=3.5",
        "PyYAML>=6",
        "psutil>=5.9",
    ],
    extras_require={
        "ground": ["autobahn>=24.4"],
        "keys": ["segno>=1.5"],
        "log": ["matplotlib>=3.8"],
        "mavlink": ["pymavlink>=2.4.41"],
        # To make certificates; TLS itself is in Python. Debian 12 has 38.
        "tls": ["cryptography>=38"],
        "sim": ["jsbsim==1.3.3; platform_machine == 'x86_64'", "matplotlib>=3.8"],
        "bench": ["pymavlink", "pluggy>=1", "blinker>=1.6", "mcap>=1.2", "simple-pid>=2.0"],
        "dev": [
            "autobahn>=24.4",
            "cryptography>=38",
            "pytest>=8",
            "pytest-xdist>=3.7",
            "pytest-timeout>=2.3",
            "hypothesis>=6.100",
            "mcap>=1.2",
            "gpxpy>=1.6",
            "segno>=1.5",
            "simple-pid>=2.0",
            "ruff>=0.6",
            "mypy>=1.11",
            "import-linter>=2.0",
            # Peers of MAVLink; tools/install adds MAVProxy without its graphics.
            "mavsdk>=4.1; platform_machine == 'x86_64'",
            "defusedxml>=0.7",
            "types-PyYAML",
            "types-psutil",
            "types-pyserial",
        ],
    },
    entry_points={
        "console_scripts": [
            "up = up.cli.__main__:main",
            "up-runner = up_runner.__main__:main",
            "up-proxy = up_proxy.__main__:main",
            "up-ground = up_ground.__main__:main",
            "up-sim = up_simulator.__main__:main",
        ],
        "up.config_files": [
            "runner = up_runner.config:RUNNER",
            "proxy = up_proxy.config:PROXY",
        ],
        "up.log_verbs": ["replay = up_ground.replay.verb:add"],
    },
)
