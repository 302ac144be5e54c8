package org.raspilot.app.ground;

import java.util.Locale;

/** The address under which a map of the system shows a place (RFC 5870 and Android's {@code q}). */
final class GeoUri {
    private GeoUri() {
    }

    /**
     * Returns {@code geo:47.1234567,8.1234567?q=47.1234567,8.1234567(label)}; the label is encoded.
     */
    static String of(double latitudeDeg, double longitudeDeg, String label) {
        // Not the user's language: a decimal comma would be another place.
        String place = String.format(Locale.ROOT, "%.7f,%.7f", latitudeDeg, longitudeDeg);
        return "geo:" + place + "?q=" + place + "(" + label + ")";
    }
}
