// Telemetry of an aircraft that navigates, beside that of the ground station's tests.

const AGES = { orientation: 12, rx: 20, servo: 20, location: 600, altitude: 30, heading: 40, battery: 20000 };

/** more: fields of flight_control, `flight_control` for all of them. */
export function navigating({ flight_control = null, ...more } = {}) {
  const modes = {
    AUTO: null, CRUISE: null, LOITER: null, GUIDED: "no_target", RETURN: null, CIRCLE: null, GLIDE: "altitude",
  };
  return {
    flight_mode: "SETPOINT",
    armed: true,
    in_flight: true,
    arduino: { connected: true, framing: "checked", switch: "high", failsafe: false },
    flight_control: flight_control ?? {
      mode: "LOITER", selected: "LOITER", fallback: null, modes, board_modes: ["FBW", "RATE"], ...more,
    },
    home: { distance: 412, bearing: 225, latitude: 50.0755, longitude: 14.4378, altitude: 312, time_s: 47 },
    location: { latitude: 50.07805, longitude: 14.44205, altitude: 401, satellites: 9 },
    navigation: {
      latitude: 50.0781, longitude: 14.4422, altitude: 401.6, height: 89.6, speed: 13.4, course: 71, climb: 0.2,
      airspeed: 14.9, heading: 63, wind: { speed: 4.2, from: 255 },
      sd: { position: 3.1, altitude: 2.2, wind: 0.6, airspeed: 0.8, heading: 4 },
      target: { latitude: 50.0777, longitude: 14.4425, altitude: 400, radius: 50 },
    },
    age_ms: { ...AGES, flight: 15, navigation: 700 },
  };
}
