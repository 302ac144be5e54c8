"""Packaging of the mission control cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-mission-control-cog",
    version="0.1.0",
    description="The link to the ground station, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"mission_control_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot"],
)
