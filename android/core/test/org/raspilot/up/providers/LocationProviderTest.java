package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.util.Map;
import org.junit.Test;
import org.raspilot.up.providers.ProviderStatus.ProviderState;
import org.raspilot.up.wire.Vectors;

/** The sent values of a fix, their times, and their display. */
public final class LocationProviderTest {
    private final ProvidersBench bench = new ProvidersBench();
    private final TestSource<Fix> gps = new TestSource<>("GPS");
    private final LocationProvider provider = new LocationProvider(gps, 500);

    @Test
    public void aFixLeavesAsTheVectorsSay() throws Exception {
        bench.run(provider);
        gps.give(new Fix(48.14859123456, 17.10774987654, 151.26, 3.14, 12.346, 271.27, 812.4, 9));
        Map<String, Object> vector = Vectors.read("general_message.json").get(2);
        assertEquals(vector.get("line"),
                Vectors.text(bench.sink.commands.get(0).toMessage().toLine()));
    }

    @Test
    public void whatIsImpossibleOrNotKnownIsLeftOut() {
        bench.run(provider);
        gps.give(new Fix(3, 4, null, null, null, null, -5.0, -1));
        assertEquals("up.location.update {latitude=3.0, longitude=4.0}", bench.sink.last());
        bench.loop.advance(1000);
        gps.give(new Fix(5, 4, null, null, null, null, 60001.0, 256));
        assertEquals("up.location.update {latitude=5.0, longitude=4.0}", bench.sink.last());
        bench.loop.advance(1000);
        gps.give(new Fix(1, 2, null, Double.NaN, Double.POSITIVE_INFINITY, null, null, null));
        assertEquals("up.location.update {latitude=1.0, longitude=2.0}", bench.sink.last());
    }

    @Test
    public void theBearingIsWithin0To360() {
        bench.run(provider);
        gps.give(new Fix(1, 2, null, null, null, 359.97, null, null));
        assertEquals("up.location.update {latitude=1.0, longitude=2.0, bearing=0.0}",
                bench.sink.last());
    }

    @Test
    public void aPlaceThatIsNoneIsToldAndNotSent() {
        bench.run(provider);
        gps.give(new Fix(90.5, 2, null, null, null, null, null, null));
        gps.give(new Fix(Double.NaN, 2, null, null, null, null, null, null));
        assertEquals(0, bench.sink.commands.size());
        assertEquals(2, bench.told.size());
        assertTrue(bench.told.get(0), bench.told.get(0).contains("latitude"));
        gps.give(new Fix(1, 2, null, null, null, null, null, null));
        assertEquals("", bench.status().problem);
        assertEquals(1, bench.sink.commands.size());
    }

    @Test
    public void aFixThatMayBeFarOffIsToldAndNotSent() {
        bench.run(provider);
        gps.give(new Fix(1, 2, null, 1200.0, null, null, null, null));
        gps.give(new Fix(1, 2, null, 50.1, null, null, null, null));
        gps.give(new Fix(1, 2, null, Double.POSITIVE_INFINITY, null, null, null, null));
        assertEquals(0, bench.sink.commands.size());
        assertEquals("told once", "[location: its reading cannot be used: "
                + "a fix that may be off by more than 50 m is not usable in flight]",
                bench.told.toString());
        bench.loop.advance(10001);
        assertEquals(ProviderState.SILENT, provider.state());
        gps.give(new Fix(1, 2, null, 50.0, null, null, null, null));
        assertEquals("up.location.update {latitude=1.0, longitude=2.0, accuracy=50.0}",
                bench.sink.last());
        assertEquals("", bench.status().problem);
    }

    @Test
    public void aSensorsNameIsAskedOnlyWhenItIsLookedFor() {
        bench.run(provider);
        int asked = gps.namesAsked;
        bench.status();
        bench.status();
        assertEquals(asked, gps.namesAsked);
        gps.name = "GPS, not permitted";
        bench.controller.restart("location");
        assertEquals("GPS, not permitted", bench.status().sensor);
        gps.name = null;
        bench.controller.restart("location");
        assertEquals("", bench.status().sensor);
    }

    @Test
    public void aQuickerGpsIsThinnedToThePeriodAndTheNewestFixLeaves() {
        bench.run(provider);
        for (int at = 0; at <= 20; at++) {
            gps.give(new Fix(at, 0, null, null, null, null, null, null));
            bench.loop.advance(100);
        }
        assertEquals("[0, 400, 900, 1400, 1900]", bench.sink.timesMs.toString());
        assertEquals(14.0, bench.sink.commands.get(3).data().get("latitude"));
    }

    @Test
    public void aFixThatCameTooEarlyLeavesLateWhenNoNewerOneComes() {
        bench.run(provider);
        gps.give(new Fix(1, 0, null, null, null, null, null, null));
        bench.loop.advance(200);
        gps.give(new Fix(2, 0, null, null, null, null, null, null));
        bench.loop.advance(5000);
        assertEquals("[0, 625]", bench.sink.timesMs.toString());
        assertEquals(2.0, bench.sink.commands.get(1).data().get("latitude"));
    }

    @Test
    public void aGpsThatJittersAboutThePeriodLosesNoFix() {
        bench.run(provider);
        for (int at = 0; at < 40; at++) {
            gps.give(new Fix(at, 0, null, null, null, null, null, null));
            bench.loop.advance(at % 2 == 0 ? 420 : 580);
        }
        assertEquals(40, bench.sink.commands.size());
    }

    @Test
    public void aFixIsSentOnceHoweverLongTheNextOneTakes() {
        bench.run(provider);
        gps.give(new Fix(1, 2, null, null, null, null, null, null));
        bench.loop.advance(60000);
        assertEquals(1, bench.sink.commands.size());
    }

    @Test
    public void theScreenIsToldTheRateAndTheAge() {
        bench.run(provider);
        bench.feed(gps, new Fix(1, 2, null, null, null, null, null, null), 500, 5000);
        ProviderStatus status = bench.status();
        assertEquals(ProviderState.SENDING, status.state);
        assertEquals(2, status.rateHz, 0);
        assertEquals(0, status.ageMs);
        assertEquals("GPS", status.sensor);
        assertEquals("latitude 1.0, longitude 2.0", status.lastText);
        bench.loop.advance(700);
        assertEquals(700, bench.status().ageMs);
        assertEquals(1, bench.status().rateHz, 0);
    }

    @Test
    public void aGpsThatSaysNothingForTenSecondsIsSilent() {
        bench.run(provider);
        assertEquals(ProviderState.WAITING, provider.state());
        assertEquals(-1, bench.status().ageMs);
        bench.loop.advance(10000);
        assertEquals(ProviderState.WAITING, provider.state());
        bench.loop.advance(1);
        assertEquals(ProviderState.SILENT, provider.state());
        gps.give(new Fix(1, 2, null, null, null, null, null, null));
        assertEquals(ProviderState.SENDING, provider.state());
        bench.loop.advance(10001);
        assertEquals(ProviderState.SILENT, provider.state());
    }

    @Test
    public void withoutALinkItWaitsAndKeepsNothingOld() {
        bench.run(provider);
        bench.sink.isOpen = false;
        bench.feed(gps, new Fix(1, 2, null, null, null, null, null, null), 500, 5000);
        assertEquals(ProviderState.WAITING, provider.state());
        bench.loop.advance(3000);
        bench.sink.isOpen = true;
        bench.controller.linkOpened();
        bench.loop.advance(3000);
        assertEquals(0, bench.sink.commands.size());
        gps.give(new Fix(3, 4, null, null, null, null, null, null));
        assertEquals(1, bench.sink.commands.size());
    }

    @Test
    public void onANewLinkAFreshFixLeavesAtOnce() {
        bench.run(provider);
        gps.give(new Fix(1, 2, null, null, null, null, null, null));
        bench.loop.advance(300);
        bench.controller.linkOpened();
        assertEquals("[0, 300]", bench.sink.timesMs.toString());
    }
}
