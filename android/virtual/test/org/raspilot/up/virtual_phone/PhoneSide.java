package org.raspilot.up.virtual_phone;

import java.util.Map;
import java.util.Random;
import org.raspilot.up.airborne.Airborne;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** The phone itself with its simulated sensors, on whatever loop. */
final class PhoneSide implements LoopProgram.Part {
    private final AirborneSettings settings;
    private final EventWriter words;
    private final PhoneEvents events;
    private SimulatedSensors sensors;
    private Airborne airborne;

    PhoneSide(AirborneSettings settings, EventWriter words) {
        this.settings = settings;
        this.words = words;
        events = new PhoneEvents(words);
    }

    @Override
    public void start(Loop loop) {
        sensors = new SimulatedSensors(loop, words);
        airborne = new Airborne(loop, settings, sensors.sensors(), events, events,
                new Random());
        airborne.start();
    }

    @Override
    public void stop() {
        airborne.stop();
        events.counters(airborne.status());
    }

    @Override
    public void onLine(Map<?, ?> fields) throws OptionException {
        sensors.update(fields);
    }
}
