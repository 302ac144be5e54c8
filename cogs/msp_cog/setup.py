"""Packaging of the MSP cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-msp-cog",
    version="0.1.0",
    description="A Betaflight board of Raspilot in place of the Arduino, by MSP",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(include=["msp_cog", "msp_cog.*"]),
    package_data={"msp_cog": ["*.yml", "py.typed"]},
    install_requires=["raspilot"],
)
