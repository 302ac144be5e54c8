"""Packaging of the reader of recorded flights; an aircraft does not need it."""

from setuptools import find_packages, setup

setup(
    name="up-flightlog",
    version="0.1.0",
    description="Reads recorded flights: findings, report, plots, exports, and 'up log'",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"up_flightlog": ["py.typed", "report/*.css"]},
    install_requires=["raspilot"],
    extras_require={"plots": ["matplotlib>=3.8"]},
    entry_points={"up.verbs": ["log = up_flightlog.cli.parser:add"]},
)
