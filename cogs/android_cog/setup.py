"""Packaging of the android cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-android-cog",
    version="0.1.0",
    description="The airborne phone: orientation, location, battery, telemetry, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"android_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot"],
)
