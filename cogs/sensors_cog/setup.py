"""Packaging of the sensors cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-sensors-cog",
    version="0.1.0",
    description="Sensors at the I2C bus of the Raspberry Pi, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"sensors_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot", "smbus2>=0.4.3"],
)
