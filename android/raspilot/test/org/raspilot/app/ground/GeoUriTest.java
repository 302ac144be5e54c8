package org.raspilot.app.ground;

import static org.junit.Assert.assertEquals;

import java.util.Locale;
import org.junit.Test;

public final class GeoUriTest {
    @Test
    public void aPlaceHasADecimalPointInEveryLanguage() {
        Locale before = Locale.getDefault();
        Locale.setDefault(Locale.GERMANY);
        try {
            assertEquals("geo:47.1234567,-8.5000000?q=47.1234567,-8.5000000(Aircraft)",
                    GeoUri.of(47.1234567, -8.5, "Aircraft"));
        } finally {
            Locale.setDefault(before);
        }
    }
}
