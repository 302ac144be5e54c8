"""Packaging of the Arduino cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-arduino-cog",
    version="0.1.0",
    description="The Arduino of Raspilot: readings, arming, flight modes, Outputs, gains, profile",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(include=["arduino_cog", "arduino_cog.*"]),
    package_data={"arduino_cog": ["*.yml", "py.typed"]},
    install_requires=["raspilot", "raspilot-serial-cog"],
)
