package org.raspilot.up.virtual_phone;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.providers.RatePolicy;
import org.raspilot.up.providers.SensorProvider;
import org.raspilot.up.providers.SensorSource;

/** Sends what a companion on board has the black box write, as {@code black_box.record}. */
final class RecordProvider extends SensorProvider<Map<?, ?>> {
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
