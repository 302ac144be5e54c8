"""Packaging of the discovery cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-discovery-cog",
    version="0.1.0",
    description="Lets the airborne phone find the Raspberry Pi, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"discovery_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot"],
)
