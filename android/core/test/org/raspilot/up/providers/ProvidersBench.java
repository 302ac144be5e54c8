package org.raspilot.up.providers;

import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;

/** A loop, a controller and a link that is open, for the tests of providers. */
final class ProvidersBench {
    final Faults faults = new Faults();
    final ManualLoop loop = new ManualLoop(null, faults);
    final ProvidersController controller = new ProvidersController(loop);
    final TestOutlet sink = new TestOutlet(loop);
    final List<String> told = new ArrayList<>();

    ProvidersBench() {
        controller.setListener((name, sentence) -> told.add(name + ": " + sentence));
    }

    void run(UpProvider provider) {
        controller.register(provider);
        controller.start(sink);
    }

    /** Returns the status of the only provider. */
    ProviderStatus status() {
        return controller.statuses().get(0);
    }

    /** Delivers a reading each periodMs for that many ms; the first after one period. */
    <R> void feed(TestSource<R> source, R reading, long periodMs, long forMs) {
        for (long passed = 0; passed < forMs; passed += periodMs) {
            loop.advance(periodMs);
            source.give(reading);
        }
    }

    /** Returns the shortest time between two that were sent. */
    long shortestGapMs() {
        long shortest = Long.MAX_VALUE;
        for (int at = 1; at < sink.timesMs.size(); at++) {
            shortest = Math.min(shortest, sink.timesMs.get(at) - sink.timesMs.get(at - 1));
        }
        return shortest;
    }
}
