package org.raspilot.up.virtual_phone;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Random;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandExecutor.HandlerFaultListener;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.CommandHandler;
import org.raspilot.up.commands.CommandRegistry;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.ground.Answer;
import org.raspilot.up.ground.GroundListener;
import org.raspilot.up.ground.GroundSide;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.TokenStore.MemoryTokenStore;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** The ground side with lines in the place of a screen. */
final class ConsoleSide implements LoopProgram.Part, GroundListener, HandlerFaultListener {
    private ConsoleOptions options;
    private final EventWriter words;
    private Loop loop;
    private GroundSide ground;
    private GainSet told;

    ConsoleSide(ConsoleOptions options, EventWriter words) {
        this.options = options;
        this.words = words;
    }

    @Override
    public void start(Loop started) {
        loop = started;
        connect();
    }

    private void connect() {
        CommandExecutor executor = new CommandExecutor(CommandRegistry.builtin(), this);
        ground = new GroundSide(
                loop, options.settings, new MemoryTokenStore(), executor, this, new Random());
        executor.registerCommand(
                Telemetry.NAME, new ConsoleTelemetry(ground, options.values, loop, words));
        ground.start();
    }

    @Override
    public void stop() {
        ground.stop();
    }

    @Override
    public void onLine(Map<?, ?> line) throws OptionException {
        Answers answers = new Answers(line.get("tag"));
        if (line.containsKey("send")) {
            send(line, answers);
        } else if (line.containsKey("gains")) {
            gains(line.get("gains"), answers);
        } else if (line.containsKey("seat")) {
            seat(line.get("seat"));
        } else if (line.containsKey("options")) {
            String given = String.valueOf(line.get("options"));
            options = ConsoleOptions.read(given.split(" "));
            ground.stop();
            words.notice("options", given);
            connect();
        } else {
            throw new OptionException("a line has neither send, gains, seat nor options");
        }
    }

    @Override
    public void onTelemetry(Telemetry telemetry) {
        // A handler of the Command prints it.
    }

    @Override
    public void onStatus(GroundStatus status) {
        Map<String, Object> event = EventWriter.event("status", "link", status.link.name());
        event.put("sentence", status.linkText() + "; " + status.controlText());
        event.put("seat", status.role == null ? null : status.role.word());
        event.put("standing", status.control.name());
        event.put("holder", number(status.owner));
        event.put("asked_by", number(status.requestedBy));
        event.put("online", status.isAircraftOnline);
        event.put("role", status.commandRole);
        event.put("security", status.securityText());
        event.put("tls", status.isTls);
        event.put("code", status.code);
        event.put("key_fault", status.keyFault);
        event.put("refused", status.refused);
        event.put("tune_in_flight", status.tuneInFlight);
        event.put("reason", status.reason);
        event.put("rejection", status.rejection);
        words.write(event);
    }

    @Override
    public void onChanged() {
        GainSet flying = ground.gains().snapshot().flying;
        if (flying != told) {
            told = flying;
            Object data = flying == null ? null : flying.toData();
            words.write(EventWriter.event("gains", "flying", data));
        }
    }

    @Override
    public void onHandlerFailed(CommandHandler handler, BaseCommand command, Throwable fault) {
        words.fault(fault);
    }

    private void send(Map<?, ?> line, Answers answers) throws OptionException {
        Object name = line.get("send");
        Object data = line.get("data");
        if (data == null) {
            data = new LinkedHashMap<>();
        }
        if (!(name instanceof String) || !(data instanceof Map)) {
            throw new OptionException("send is a Command's name, data an object");
        }
        ground.send(new BaseCommand((String) name, keyed(data)),
                ground.telemetry().beacon, answers);
    }

    private void gains(Object wanted, Answers answers) throws OptionException {
        Long beacon = ground.telemetry().beacon;
        if ("ask".equals(wanted)) {
            ground.gains().request(answers);
        } else if ("undo".equals(wanted)) {
            ground.gains().undo(beacon, answers);
        } else if (wanted instanceof Map) {
            try {
                ground.gains().set(GainSet.ofData(keyed(wanted)), beacon, answers);
            } catch (InvalidCommandException error) {
                throw new OptionException("gains: " + error.getMessage());
            }
        } else {
            throw new OptionException("gains: 'ask', 'undo' or a set of them");
        }
    }

    private void seat(Object wanted) throws OptionException {
        boolean isDone;
        if ("request".equals(wanted)) {
            isDone = ground.requestControl();
        } else if ("release".equals(wanted)) {
            isDone = ground.releaseControl();
        } else if (wanted instanceof Map && ((Map<?, ?>) wanted).get("give") instanceof Long) {
            isDone = ground.giveControl(((Long) ((Map<?, ?>) wanted).get("give")).intValue());
        } else {
            throw new OptionException("seat: 'request', 'release' or {\"give\": number}");
        }
        if (!isDone) {
            words.notice("no_control", "control cannot be requested or given now");
        }
    }

    private static Map<String, Object> keyed(Object object) {
        Map<String, Object> keyed = new LinkedHashMap<>();
        for (Map.Entry<?, ?> each : ((Map<?, ?>) object).entrySet()) {
            keyed.put((String) each.getKey(), each.getValue());
        }
        return keyed;
    }

    private static Long number(Integer value) {
        return value == null ? null : Long.valueOf(value);
    }

    private final class Answers implements AnswerListener {
        private final Object tag;

        Answers(Object tag) {
            this.tag = tag;
        }

        @Override
        public void onAnswer(Answer answer) {
            Map<String, Object> event = EventWriter.event("answer", "tag", tag);
            event.put("name", answer.name);
            event.put("outcome", answer.outcome.name());
            event.put("code", answer.code);
            event.put("reason", answer.reason);
            event.put("round_trip_ms", answer.roundTripMs);
            event.put("data", answer.data);
            words.write(event);
        }
    }
}
