package org.raspilot.up.virtual_phone;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Random;
import org.raspilot.up.airborne.Airborne;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.RatePolicy;
import org.raspilot.up.providers.SensorProvider;
import org.raspilot.up.providers.SensorSource;
import org.raspilot.up.providers.Side;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** The phone itself with its simulated sensors, on whatever loop. */
final class PhoneSide implements LoopProgram.Part {
    private final PhoneOptions options;
    private final EventWriter words;
    private final PhoneEvents events;
    private SimulatedSensors sensors;
    private SimulatedSource<Map<?, ?>> record;
    private Airborne airborne;

    PhoneSide(PhoneOptions options, EventWriter words) {
        this.options = options;
        this.words = words;
        events = new PhoneEvents(words);
    }

    @Override
    public void start(Loop loop) {
        sensors = new SimulatedSensors(loop, words);
        airborne = new Airborne(loop, options.settings, sensors.sensors(), events, events,
                new Random());
        if (options.isRecording) {
            record = new SimulatedSource<>("record", words);
            airborne.providers().register(new RecordProvider(record));
        }
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
        Object content = fields.get("record");
        if (content != null && record == null) {
            throw new OptionException("record: only with --record");
        } else if (content instanceof Map) {
            record.deliver((Map<?, ?>) content);
        } else if (content != null) {
            throw new OptionException("record must be an object");
        }
        Object level = fields.get("level");
        if (level != null) {
            calibrate(String.valueOf(level));
        }
    }

    private void calibrate(String nose) throws OptionException {
        try {
            words.notice("mounting", "mounting: "
                    + airborne.calibrate(Side.valueOf(nose)).toText());
        } catch (IllegalArgumentException | IllegalStateException error) {
            throw new OptionException("not calibrated: " + error.getMessage());
        }
    }

    /** Sends what a companion on board has the black box write, as {@code black_box.record}. */
    static final class RecordProvider extends SensorProvider<Map<?, ?>> {
        /** The quickest: the black box takes 200 a second of all together. */
        private static final int PERIOD_MS = 50;

        private static final int SILENCE_MS = 3000;

        /** Takes the {@code "record"} of an input line: topic and content. */
        RecordProvider(SensorSource<Map<?, ?>> source) {
            super("record", source, RatePolicy.stream(PERIOD_MS, SILENCE_MS));
        }

        @Override
        protected BaseCommand read(Map<?, ?> reading) {
            Map<String, Object> data = new LinkedHashMap<>();
            data.put("topic", reading.get("topic"));
            data.put("content", reading.get("content"));
            return new BaseCommand(Commands.RECORD, data);
        }
    }
}
