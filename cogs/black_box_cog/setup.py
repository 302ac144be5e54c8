"""Packaging of the black box cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-black-box-cog",
    version="0.1.0",
    description="The flight recorder: every Command on the bus into MCAP files, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"black_box_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot"],
    entry_points={"up.flights_folder": ["black_box = black_box_cog.config:BLACK_BOX"]},
)
