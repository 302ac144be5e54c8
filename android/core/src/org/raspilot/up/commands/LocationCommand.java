package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** The aircraft's position from a satellite receiver, WGS 84. Source: docs/protocols.md 5. */
public final class LocationCommand extends BaseCommand {
    public static final String NAME = "up.location.update";
    /** An older name of this Command. */
    public static final String ALIAS = "up.location.change";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new LocationCommand(message);

    public final double latitudeDeg;
    public final double longitudeDeg;
    /** The altitude in m, or null. */
    public final Double altitudeM;
    /** The accuracy in m, or null. */
    public final Double accuracyM;
    /** The speed over ground in m/s, or null. */
    public final Double speedMS;
    /** The course over ground in deg, or null. */
    public final Double bearingDeg;

    /**
     * Creates the Command; null values are left out.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public LocationCommand(double latitudeDeg, double longitudeDeg, Double altitudeM, Double
            accuracyM, Double speedMS, Double bearingDeg) {
        this(new GeneralMessage(NAME,
                data(latitudeDeg, longitudeDeg, altitudeM, accuracyM, speedMS, bearingDeg)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public LocationCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        latitudeDeg = fields.number("latitude", -90, 90);
        longitudeDeg = fields.number("longitude", -180, 180);
        altitudeM = fields.optionalNumber("altitude", -1000, 100000);
        accuracyM = fields.optionalNumber("accuracy", 0, Double.MAX_VALUE);
        speedMS = fields.optionalNumber("speed", 0, Double.MAX_VALUE);
        bearingDeg = fields.optionalNumber("bearing", -360, 360);
        // Both are computed on board; they must only be what they claim to be.
        fields.optionalNumber("distance_from_home", -Double.MAX_VALUE, Double.MAX_VALUE);
        fields.optionalNumber("required_bearing", -Double.MAX_VALUE, Double.MAX_VALUE);
    }

    private static Map<String, Object> data(double latitudeDeg, double longitudeDeg, Double
            altitudeM, Double accuracyM, Double speedMS, Double bearingDeg) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("latitude", latitudeDeg);
        data.put("longitude", longitudeDeg);
        if (altitudeM != null) {
            data.put("altitude", altitudeM);
        }
        if (accuracyM != null) {
            data.put("accuracy", accuracyM);
        }
        if (speedMS != null) {
            data.put("speed", speedMS);
        }
        if (bearingDeg != null) {
            data.put("bearing", bearingDeg);
        }
        return data;
    }
}
