"""Performance of the project, each figure beside a peer's in the same run; `python -m bench`."""
