"""Packaging of the metrics cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-metrics-cog",
    version="0.1.0",
    description="Telemetry and counters of the daemon for Prometheus, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"metrics_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot"],
)
