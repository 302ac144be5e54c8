"""Packaging of the MAVLink cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-mavlink-cog",
    version="0.1.0",
    description="QGroundControl, MAVProxy, MAVSDK and Mission Planner, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"mavlink_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot", "raspilot-mission-control-cog"],
)
