package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.List;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.providers.AltitudeProvider.Pressure;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;
import org.raspilot.up.providers.ProviderStatus.ProviderState;

/** Registering, starting and stopping, and the isolation of a provider's fault. */
public final class ProvidersControllerTest {
    private final ProvidersBench bench = new ProvidersBench();
    private final List<String> calls = new ArrayList<>();

    @Test
    public void allStartInTheirOrderAndStopInTheReverse() {
        for (String name : new String[] {"one", "two", "three"}) {
            bench.controller.register(new Named(name, new Noted(name)));
        }
        bench.controller.start(bench.sink);
        bench.controller.stop();
        assertEquals("[+one, +two, +three, -three, -two, -one]", calls.toString());
    }

    @Test
    public void oneThatIsRegisteredLaterStartsAtOnce() {
        bench.controller.start(bench.sink);
        bench.controller.register(new Named("late", new Noted("late")));
        assertEquals("[+late]", calls.toString());
    }

    @Test
    public void aNameIsGivenOnce() {
        bench.controller.register(new Named("one", new Noted("one")));
        assertThrows(IllegalArgumentException.class, () ->
                bench.controller.register(new Named("one", new Noted("other"))));
    }

    @Test
    public void anAbsentSensorIsToldAndIsNoError() {
        TestSource<Fix> absent = new TestSource<>("no GPS");
        absent.isPresent = false;
        bench.run(new LocationProvider(absent, 500));
        assertEquals("[location: no GPS]", bench.told.toString());
        assertEquals(ProviderState.ABSENT, bench.status().state);
        assertEquals("", bench.status().problem);
        assertEquals(0, absent.periodsMs.size());
        bench.loop.advance(60000);
        assertEquals(ProviderState.ABSENT, bench.status().state);
        assertEquals(1, bench.told.size());
        bench.controller.stop();
        bench.faults.mustBeNone();
    }

    @Test
    public void aSourceThatIsNotThereNeverReads() {
        SensorSource<Fix> absent = new AbsentSource<>("no GPS");
        bench.run(new LocationProvider(absent, 500));
        assertEquals(ProviderState.ABSENT, bench.status().state);
        assertEquals("no GPS", bench.status().sensor);
    }

    @Test
    public void aSensorThatRefusesHarmsNoOther() {
        TestSource<Fix> gps = new TestSource<>("GPS");
        gps.fault = new SecurityException("no permission");
        bench.controller.register(new LocationProvider(gps, 500));
        TestSource<Pressure> barometer = new TestSource<>("barometer");
        bench.controller.register(new AltitudeProvider(barometer, 200));
        bench.controller.start(bench.sink);
        barometer.give(new Pressure(1000));
        assertEquals(1, bench.sink.commands.size());
        assertEquals(ProviderState.STOPPED, bench.status().state);
        assertTrue(bench.status().problem.endsWith(": no permission"));
        gps.fault = null;
        assertTrue(bench.controller.restart("location"));
        gps.give(new Fix(1, 2, null, null, null, null, null, null));
        assertEquals(2, bench.sink.commands.size());
        assertEquals("", bench.status().problem);
    }

    @Test
    public void aSensorThatCannotBeLeftDoesNotKeepTheOthersRunning() {
        bench.controller.register(new Named("first", new Noted("first")));
        bench.controller.register(new Named("bad", new Noted("bad") {
            @Override
            public void unsubscribe() {
                throw new IllegalStateException("stuck");
            }
        }));
        bench.controller.start(bench.sink);
        bench.controller.stop();
        assertEquals("[+first, +bad, -first]", calls.toString());
        assertEquals(1, bench.told.size());
        assertTrue(bench.told.get(0).endsWith(": stuck"));
    }

    @Test
    public void aProviderThatThrowsAtAReadingHarmsNobodyAndIsTold() {
        TestSource<Fix> gps = new TestSource<>("GPS");
        bench.run(new SensorProvider<Fix>("broken", gps, RatePolicy.stream(100, 1000)) {
            @Override
            protected BaseCommand read(Fix reading) {
                throw new IllegalStateException("a mistake");
            }
        });
        gps.give(new Fix(1, 2, null, null, null, null, null, null));
        gps.give(new Fix(1, 2, null, null, null, null, null, null));
        assertEquals(1, bench.told.size());
        assertTrue(bench.told.get(0).endsWith(": a mistake"));
    }

    @Test
    public void afterTheStopNothingLeaves() {
        TestSource<BatteryLevel> battery = new TestSource<>("battery");
        bench.run(new BatteryProvider(battery));
        battery.give(new BatteryLevel(50));
        SensorListener<BatteryLevel> late = battery.listener;
        bench.controller.stop();
        late.onReading(new BatteryLevel(40));
        bench.loop.advance(60000);
        assertEquals(1, bench.sink.commands.size());
        assertEquals(ProviderState.STOPPED, bench.status().state);
        assertEquals(0, bench.loop.pendingTimers());
    }

    private final class Named extends SensorProvider<String> {
        Named(String name, SensorSource<String> source) {
            super(name, source, RatePolicy.stream(100, 1000));
        }

        @Override
        protected BaseCommand read(String reading) {
            return new BaseCommand(reading, null);
        }
    }

    private class Noted implements SensorSource<String> {
        private final String name;

        Noted(String name) {
            this.name = name;
        }

        @Override
        public boolean isPresent() {
            return true;
        }

        @Override
        public String name() {
            return name;
        }

        @Override
        public void subscribe(long periodMs, SensorListener<String> listener) {
            calls.add("+" + name);
        }

        @Override
        public void unsubscribe() {
            calls.add("-" + name);
        }
    }
}
