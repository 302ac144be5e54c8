"""Packaging of the CRSF cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-crsf-cog",
    version="0.1.0",
    description="An ExpressLRS or Crossfire receiver on a UART of the Raspberry Pi, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"crsf_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot"],
)
