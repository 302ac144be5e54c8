"""The runner: spawns and watches Raspilot instances."""
