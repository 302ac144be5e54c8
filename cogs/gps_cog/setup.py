"""Packaging of the GPS cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-gps-cog",
    version="0.1.0",
    description="A dedicated satellite receiver instead of the phone's, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"gps_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot", "pyubx2>=1.4", "pynmeagps>=1.1"],
)
