"""Packaging of the load guard cog."""

from setuptools import find_packages, setup

setup(
    name="raspilot-load-guard-cog",
    version="0.1.0",
    description="Panic Mode under load, and the state of the system, for Up",
    license="MIT",
    python_requires=">=3.11",
    packages=find_packages(),
    package_data={"load_guard_cog": ["registered_modules.yml", "py.typed"]},
    install_requires=["raspilot", "psutil>=5.9"],
)
