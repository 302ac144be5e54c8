package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import org.junit.Test;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;
import org.raspilot.up.providers.ProviderStatus.ProviderState;

/** The battery's level: on change, and again and again. */
public final class BatteryProviderTest {
    private final ProvidersBench bench = new ProvidersBench();
    private final TestSource<BatteryLevel> battery = new TestSource<>("battery");
    private final BatteryProvider provider = new BatteryProvider(battery);

    @Test
    public void theLevelLeavesInWholePercents() {
        bench.run(provider);
        battery.give(new BatteryLevel(83.4));
        assertEquals("android.battery {level=83}", bench.sink.last());
    }

    @Test
    public void itIsRepeatedEachTenSecondsAlthoughTheSensorIsQuiet() {
        bench.run(provider);
        battery.give(new BatteryLevel(83));
        bench.loop.advance(35000);
        assertEquals("[0, 10000, 20000, 30000]", bench.sink.timesMs.toString());
        assertEquals(ProviderState.SENDING, provider.state());
    }

    @Test
    public void aChangeLeavesAtOnceAndTheSameLevelDoesNot() {
        bench.run(provider);
        battery.give(new BatteryLevel(83));
        bench.loop.advance(4000);
        battery.give(new BatteryLevel(83));
        bench.loop.advance(1000);
        battery.give(new BatteryLevel(82));
        bench.loop.advance(10000);
        assertEquals("[0, 5000, 15000]", bench.sink.timesMs.toString());
    }

    @Test
    public void aLevelThatFluttersIsSentOnceASecond() {
        bench.run(provider);
        for (int at = 0; at < 50; at++) {
            battery.give(new BatteryLevel(50 + at % 2));
            bench.loop.advance(100);
        }
        assertEquals(1000, bench.shortestGapMs());
    }

    @Test
    public void onANewLinkTheLevelIsToldHoweverOldItIs() {
        bench.run(provider);
        battery.give(new BatteryLevel(60));
        bench.sink.isOpen = false;
        bench.loop.advance(300000);
        bench.sink.isOpen = true;
        bench.controller.linkOpened();
        assertEquals("[0, 300000]", bench.sink.timesMs.toString());
    }

    @Test
    public void aLevelThatIsNoneIsNotSent() {
        bench.run(provider);
        for (double bad : new double[] {-1, 100.6, Double.NaN}) {
            battery.give(new BatteryLevel(bad));
            assertTrue(bench.status().problem, bench.status().problem.contains("percent"));
        }
        assertEquals(0, bench.sink.commands.size());
    }

    @Test
    public void aBatteryThatNeverSpokeIsSilentAfterTenSeconds() {
        bench.run(provider);
        bench.loop.advance(10001);
        assertEquals(ProviderState.SILENT, provider.state());
    }
}
