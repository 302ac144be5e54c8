package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;

import java.util.Collections;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.providers.ProviderStatus.ProviderState;

/**
 * How to add your own sensor: one class and one registration.
 *
 * <p>In this example the flight log records the light on the aeroplane. The provider defines which
 * sensor it reads, how often it sends, and which Command a reading becomes; an absent sensor, Panic
 * Mode, lost links, rates for the screen and faults are not its concern.
 */
public final class OwnProviderExampleTest {

    /** Sends how bright it is on board, once a second, into the flight log. */
    static final class LightProvider extends SensorProvider<Light> {
        LightProvider(SensorSource<Light> source) {
            super("light", source, RatePolicy.stream(1000, 5000));
        }

        @Override
        protected BaseCommand read(Light light) {
            return Commands.record(
                    "phone.light", Collections.singletonMap("lux", light.lux));
        }
    }

    static final class Light {
        final double lux;

        Light(double lux) {
            this.lux = lux;
        }
    }

    @Test
    public void aProviderIsOneClassAndOneRegistration() {
        ProvidersBench bench = new ProvidersBench();
        TestSource<Light> sensor = new TestSource<>("light sensor");

        bench.controller.register(new LightProvider(sensor));

        bench.controller.start(bench.sink);
        sensor.give(new Light(740));
        assertEquals("black_box.record {topic=phone.light, content={lux=740.0}}",
                bench.sink.last());
        assertEquals(ProviderState.SENDING, bench.status().state);
    }
}
