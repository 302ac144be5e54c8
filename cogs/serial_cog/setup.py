"""Packaging of the serial cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-serial-cog",
    version="0.1.0",
    description="The serial line of Raspilot: finds the Arduino, keeps the port open, frames bytes",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(include=["serial_cog", "serial_cog.*"]),
    package_data={"serial_cog": ["*.yml", "py.typed"]},
    install_requires=["raspilot", "pyserial>=3.5"],
)
