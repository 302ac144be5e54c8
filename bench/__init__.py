"""How fast the project is, each figure beside a peer's in the same run; `python -m bench`."""
