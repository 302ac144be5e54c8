package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;

import org.junit.Test;

/** Where the nose points, by the mounting and the declination. */
public final class HeadingProviderTest {
    private final ProvidersBench bench = new ProvidersBench();
    private final TestSource<Rotation> compass = new TestSource<>("rotation vector");
    private final HeadingProvider provider =
            new HeadingProvider(compass, Mounting.of(Side.RIGHT, Side.SCREEN), 200);

    @Test
    public void itIsTheNosesNotThePhones() {
        bench.run(provider);
        compass.give(new Rotation(1, 0, 0, 0, 0));
        assertEquals("up.heading.change {heading=90.0, mode=actual}", bench.sink.last());
    }

    @Test
    public void theDeclinationMakesItTrue() {
        bench.run(provider);
        provider.setDeclinationDeg(-4.26);
        compass.give(new Rotation(1, 0, 0, 0, 0));
        assertEquals("up.heading.change {heading=85.7, mode=actual}", bench.sink.last());
    }

    @Test
    public void anotherMountingHoldsForTheNextReading() {
        bench.run(provider);
        provider.setMounting(Mounting.FLAT);
        compass.give(new Rotation(1, 0, 0, 0, 0));
        assertEquals("up.heading.change {heading=0.0, mode=actual}", bench.sink.last());
    }
}
