"""MAVLink aboard: ground stations that speak it watch and command the aircraft."""
