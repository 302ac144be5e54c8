package org.raspilot.app;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.robolectric.Shadows.shadowOf;

import android.app.Service;
import android.content.Context;
import android.content.Intent;
import android.hardware.Sensor;
import android.location.Location;
import android.location.LocationManager;
import android.os.SystemClock;
import java.io.IOException;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.Up;
import org.raspilot.up.loop.SelectorLoop;
import org.robolectric.annotation.Config;

/** False values from a phone's own sensors: they end no flight, and are never sent. */
@Config(sdk = 29)
public final class BadReadingsTest extends AppBench {
    private PlayedBoard board;

    @Before
    public void listen() throws IOException {
        board = new PlayedBoard();
        handset.set(R.string.key_host, "127.0.0.1");
        handset.set(R.string.key_general_port, "" + board.port());
        handset.fitSensors();
    }

    @After
    public void close() throws IOException {
        Up.setInstance(null);
        board.close();
    }

    private int start() {
        return handset.deliver(new Intent(handset.application, RaspilotUpService.class), 1);
    }

    private void locateByNetwork() {
        LocationManager manager = (LocationManager) handset.application
                .getSystemService(Context.LOCATION_SERVICE);
        Location location = new Location(LocationManager.NETWORK_PROVIDER);
        location.setLatitude(41);
        location.setLongitude(13);
        location.setAccuracy(20);
        location.setTime(System.currentTimeMillis());
        location.setElapsedRealtimeNanos(SystemClock.elapsedRealtime() * 1000000L + 1);
        shadowOf(manager).setProviderEnabled(LocationManager.NETWORK_PROVIDER, true);
        shadowOf(manager).simulateLocation(location);
    }

    @Test
    public void aRotationOfFourZerosIsPassedOver() throws Exception {
        start();
        Wait.until("the heading", () -> {
            handset.sense(Sensor.TYPE_ROTATION_VECTOR, 0, 0, 0, 0);
            handset.sense(Sensor.TYPE_ROTATION_VECTOR, TestPhone.BANKED);
            return board.hasHeard("up.heading.change");
        });
    }

    @Test
    public void readingsOfTooFewValuesAreSaidOnceAndPassedOver() throws Exception {
        handset.set(R.string.key_redundant_orientation, true);
        start();
        String refused = handset.application.getString(R.string.lack_refused);
        Wait.until("a sentence", () -> {
            handset.sense(Sensor.TYPE_GYROSCOPE, 1);
            return count(refused) > 0;
        });
        handset.sense(Sensor.TYPE_GYROSCOPE, 1);
        Wait.pass(0);
        assertEquals(1, count(refused));
    }

    @Test
    public void whatTheNetworkKnowsIsNotSent() throws Exception {
        start();
        Wait.until("the location", () -> {
            locateByNetwork();
            handset.locate(43.5, 13, 345);
            return board.hasHeard("up.location.update");
        });
        String all = board.heard().toString();
        mustSay("43.5", all);
        assertFalse(all, all.contains("41.0"));
    }

    @Test
    public void theUpOfAnotherPartOfTheProcessIsASentence() throws Exception {
        SelectorLoop loop = new SelectorLoop("another", fault -> {
            throw new AssertionError(fault);
        });
        Up.setInstance(new Up(loop, (handler, command, fault) -> { }));
        assertEquals(Service.START_NOT_STICKY, start());
        assertNull(handset.up);
        assertEquals(1, count("already"));
    }

    private int count(String words) {
        int found = 0;
        for (AppLog.Entry each : RaspilotApplication.of(handset.application).events()
                .entries()) {
            found += each.text.contains(words) ? each.times : 0;
        }
        return found;
    }
}
