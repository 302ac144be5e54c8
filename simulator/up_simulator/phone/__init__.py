"""The airborne phone: a stub in Python, and the app's own Up Library on a Java virtual machine."""
