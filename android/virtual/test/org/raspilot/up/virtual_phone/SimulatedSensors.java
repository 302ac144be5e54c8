package org.raspilot.up.virtual_phone;

import java.util.List;
import java.util.Map;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.AltitudeProvider.Pressure;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;
import org.raspilot.up.providers.Fix;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.RotationRate;
import org.raspilot.up.providers.Sensors;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** All sensors of the virtual phone, fed by the lines of {@link VirtualPhone}'s page. */
final class SimulatedSensors {
    private final Loop loop;
    private final SimulatedSource<Fix> location;
    private final SimulatedSource<Rotation> rotation;
    private final SimulatedSource<RotationRate> rate;
    private final SimulatedSource<Pressure> pressure;
    private final SimulatedSource<BatteryLevel> battery;

    /** Makes them; readings get the loop's time. */
    SimulatedSensors(Loop loop, EventWriter words) {
        this.loop = loop;
        location = new SimulatedSource<>("fix", words);
        rotation = new SimulatedSource<>("rotation", words);
        rate = new SimulatedSource<>("rate", words);
        pressure = new SimulatedSource<>("pressure", words);
        battery = new SimulatedSource<>("battery", words);
    }

    /**
     * Takes the readings of a line, on the loop; the gyroscope's before the rotation's, which is
     * sent with it.
     *
     * @throws OptionException when one is not a reading (a sentence)
     */
    void update(Map<?, ?> line) throws OptionException {
        long nowMs = loop.nowMs();
        Object each = line.get("fix");
        if (each != null) {
            location.deliver(fix(each));
        }
        each = line.get("pressure");
        if (each != null) {
            pressure.deliver(new Pressure(number("pressure", each)));
        }
        each = line.get("rate");
        if (each != null) {
            double[] values = numbers("rate", each, 3);
            rate.deliver(new RotationRate(values[0], values[1], values[2], nowMs));
        }
        each = line.get("rotation");
        if (each != null) {
            double[] values = numbers("rotation", each, 4);
            rotation.deliver(turned(values, nowMs));
        }
        each = line.get("battery");
        if (each != null) {
            battery.deliver(new BatteryLevel(number("battery", each)));
        }
    }

    Sensors sensors() {
        return new Sensors(location, rotation, rate, pressure, battery);
    }

    private static Rotation turned(double[] values, long nowMs) throws OptionException {
        try {
            return new Rotation(values[0], values[1], values[2], values[3], nowMs);
        } catch (IllegalArgumentException error) {
            throw new OptionException("rotation: " + error.getMessage());
        }
    }

    private static Fix fix(Object value) throws OptionException {
        if (!(value instanceof Map)) {
            throw new OptionException("fix must be an object");
        }
        Map<?, ?> fields = (Map<?, ?>) value;
        Double satellites = numberOrNull("fix.satellites", fields.get("satellites"));
        return new Fix(
                number("fix.latitude", fields.get("latitude")),
                number("fix.longitude", fields.get("longitude")),
                numberOrNull("fix.altitude", fields.get("altitude")),
                numberOrNull("fix.accuracy", fields.get("accuracy")),
                numberOrNull("fix.speed", fields.get("speed")),
                numberOrNull("fix.bearing", fields.get("bearing")),
                numberOrNull("fix.age_ms", fields.get("age_ms")),
                satellites == null ? null : Integer.valueOf(satellites.intValue()));
    }

    private static double[] numbers(String name, Object value, int count) throws OptionException {
        if (!(value instanceof List) || ((List<?>) value).size() != count) {
            throw new OptionException(name + " must be a list of " + count + " numbers");
        }
        double[] found = new double[count];
        for (int at = 0; at < count; at++) {
            found[at] = number(name, ((List<?>) value).get(at));
        }
        return found;
    }

    private static Double numberOrNull(String name, Object value) throws OptionException {
        return value == null ? null : Double.valueOf(number(name, value));
    }

    private static double number(String name, Object value) throws OptionException {
        if (!(value instanceof Number)) {
            throw new OptionException(name + " must be a number");
        }
        return ((Number) value).doubleValue();
    }
}
