"""MAVLink for aircraft on Up: translation, and the endpoints that ground stations use."""
