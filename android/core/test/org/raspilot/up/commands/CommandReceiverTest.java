package org.raspilot.up.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.junit.Test;
import org.raspilot.up.loop.ManualLoop;

public final class CommandReceiverTest {
    private static final List<String> NOTHING = Collections.emptyList();

    private final List<Throwable> loopFaults = new ArrayList<>();
    private final ManualLoop loop = new ManualLoop(null, fault -> loopFaults.add(fault));
    private final HandlerFaults faults = new HandlerFaults();
    private final CommandRegistry registry = CommandRegistry.builtin();
    private final CommandExecutor executor = new CommandExecutor(registry, faults);
    private final CommandReceiver receiver = new CommandReceiver(registry, executor, loop);
    private final Answers answers = new Answers();
    private final Recorder speaker = new Recorder();

    public CommandReceiverTest() {
        executor.registerCommand(Commands.SPEAK, speaker);
    }

    @Test
    public void aCommandWithAnIdIsCarriedOutAndAcknowledged() {
        receive(speak("7", "hello"));
        assertEquals("hello", speaker.commands.get(0).data().get("text"));
        assertEquals(Arrays.asList("ack 7"), answers.heard());
    }

    @Test
    public void aCommandWithoutAnIdIsAnsweredByNothing() {
        receive("{\"name\": \"android.speak\", \"data\": {\"text\": \"hello\"}}");
        receive("{\"name\": \"android.speak\", \"data\": {\"text\": \"\"}}");
        receive("{\"name\": \"app.unknown\"}");
        receive("no JSON");
        assertEquals(1, speaker.commands.size());
        assertEquals(NOTHING, answers.heard());
        assertEquals(3, receiver.count("received"));
        assertEquals(1, receiver.count("invalid"));
        assertEquals(1, receiver.count("unknown"));
        assertEquals(1, receiver.count("malformed"));
    }

    @Test
    public void refusalsSayWhy() {
        receive("{\"name\": \"app.unknown\", \"id\": 1}");
        receive("{\"name\": \"android.speak\", \"id\": 2}");
        receive("{\"name\": \"android.speak\", \"id\": 3, \"data\": NaN}");
        receive("{\"name\": \"load_guard.panic\", \"id\": 4, \"data\": {\"panic\": 1}}");
        receive("{\"name\": \"up.panic\", \"id\": 5,"
                + " \"data\": {\"panic\": true, \"delay_ms\": 9}}");
        assertEquals(Arrays.asList(
                "nack 1 unknown no Command 'app.unknown'",
                "nack 2 invalid android.speak: text is missing",
                "nack 3 malformed NaN is not a JSON number",
                "nack 4 invalid up.panic: panic must be true or false, not 1",
                "nack 5 unavailable no handler for up.panic"), answers.heard());
        assertEquals(0, speaker.commands.size());
    }

    @Test
    public void aHandlersRefusalAndFaultAreAnswered() {
        speaker.refusal = new CommandRefusedException(NackCode.UNAVAILABLE, "mute");
        receive(speak("1", "a"));
        speaker.refusal = null;
        speaker.fault = new IllegalStateException("secret");
        receive(speak("2", "a"));
        List<String> heard = answers.heard();
        assertEquals("nack 1 unavailable mute", heard.get(0));
        assertTrue(heard.get(1).startsWith("nack 2 failed "));
        assertFalse(heard.get(1).contains("secret"));
        assertEquals(1, faults.faults.size());
    }

    @Test
    public void aRepeatedIdIsAnsweredAgainAndNotCarriedOutAgain() {
        receive(speak("7", "hello"));
        receive(speak("7", "hello"));
        assertEquals(1, speaker.commands.size());
        assertEquals(Arrays.asList("ack 7", "ack 7"), answers.heard());
        assertEquals(1, receiver.count("repeated"));
        receive("{\"name\": \"app.unknown\", \"id\": 1}");
        receive("{\"name\": \"app.unknown\", \"id\": 1}");
        assertEquals(2, answers.heard().size());
        assertEquals(1, receiver.count("unknown"));
    }

    @Test
    public void anIdWithOtherContentIsAnotherCommand() {
        receive(speak("7", "hello"));
        receive(speak("7", "goodbye"));
        assertEquals(2, speaker.commands.size());
        receive(speak("7", "hello"));
        assertEquals(3, speaker.commands.size());
        receive("{\"name\": \"app.unknown\", \"data\": {\"text\": \"hello\"}, \"id\": \"7\"}");
        assertEquals(Arrays.asList("ack 7", "ack 7", "ack 7",
                "nack 7 unknown no Command 'app.unknown'"), answers.heard());
    }

    @Test
    public void anIdIsRememberedForItsLinkOnly() {
        receive(speak("7", "hello"));
        Answers other = new Answers();
        byte[] line = bytes(speak("7", "hello"));
        receiver.receiveLine(line, line.length, other);
        assertEquals(2, speaker.commands.size());
        assertEquals(Arrays.asList("ack 7"), other.heard());
    }

    @Test
    public void anIdIsForgottenAfterAMinute() {
        receive(speak("7", "hello"));
        loop.advance(60000);
        receive(speak("7", "hello"));
        assertEquals(1, speaker.commands.size());
        loop.advance(1);
        receive(speak("7", "hello"));
        assertEquals(2, speaker.commands.size());
    }

    @Test
    public void theNewestTwoHundredAndFiftySixIdsAreRemembered() {
        for (int i = 0; i <= 256; i++) {
            receive(speak("i" + i, "hello"));
        }
        receive(speak("i1", "hello"));
        assertEquals(257, speaker.commands.size());
        receive(speak("i0", "hello"));
        assertEquals(258, speaker.commands.size());
    }

    @Test
    public void aCommandThatComesDuringAnotherIsAnsweredAfterIt() {
        executor.registerCommand(Commands.MARK, command -> {
            receive(speak("inner", "hello"));
            receive(speak("inner", "hello"));
            assertEquals(NOTHING, answers.heard());
        });
        receive("{\"name\": \"black_box.mark\", \"id\": \"outer\", \"data\": {\"text\": \"x\"}}");
        assertEquals(Arrays.asList("ack outer", "ack inner"), answers.heard());
        assertEquals(1, speaker.commands.size());
    }

    @Test
    public void anOlderNameIsTheCommandItself() {
        Recorder panic = new Recorder();
        executor.registerCommand(Commands.PANIC, panic);
        receive("{\"name\": \"load_guard.panic\", \"id\": 1,"
                + " \"data\": {\"panic\": false, \"delay_ms\": 0.5}}");
        assertEquals(Arrays.asList("ack 1"), answers.heard());
        assertEquals("up.panic", panic.commands.get(0).name());
        assertEquals(0.5, panic.commands.get(0).data().get("delay_ms"));
    }

    @Test
    public void anApplicationsFaultyCommandCostsItsMessageOnly() {
        registry.register("app.broken", message -> {
            throw new IllegalStateException("broken");
        });
        receive("{\"name\": \"app.broken\", \"id\": 1}");
        receive(speak("2", "hello"));
        List<String> heard = answers.heard();
        assertTrue(heard.get(0).startsWith("nack 1 failed "));
        assertEquals("ack 2", heard.get(1));
        loop.advance(0);
        assertEquals("broken", loopFaults.get(0).getMessage());
    }

    @Test
    public void aLongReasonIsShortened() {
        String face = "\ud83d\ude00";
        StringBuilder reason = new StringBuilder();
        for (int i = 0; i < 501; i++) {
            reason.append(face);
        }
        speaker.refusal = new CommandRefusedException(reason.toString());
        receive(speak("1", "a"));
        String heard = answers.heard().get(0);
        assertTrue(heard, heard.endsWith(face + "\u2026"));
        assertEquals("nack 1 refused ".length() + 499, heard.length());
    }

    @Test
    public void whatARefusalQuotesCanBeSent() {
        String face = "\ud83d\ude00";
        String nearlyForty = "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx";
        String quoted = nearlyForty + face + face;
        receive("{\"name\": \"android.speak\", \"id\": 1, \"data\": {\"text\": \"" + quoted
                + "\", \"" + quoted + "\": 1, \"" + quoted + "\": 2}}");
        receive("{\"name\": \"up.panic\", \"id\": 2, \"data\": {\"panic\": \"" + quoted
                + "\"}}");
        receive("{\"name\": \"" + nearlyForty + "xxxxxxxxxxxxxxxxxxxxxxxx" + face
                + "\", \"id\": 3}");
        speaker.refusal = new CommandRefusedException("half: \ud83d\nand\u202e more");
        receive(speak("4", "a"));
        List<String> heard = answers.heard();
        assertEquals(4, heard.size());
        assertTrue(heard.get(1), heard.get(1).contains("\"" + nearlyForty + "\u2026\""));
        assertTrue(heard.get(3).endsWith(" refused half:  and more"));
    }

    private void receive(String line) {
        byte[] bytes = bytes(line);
        receiver.receiveLine(bytes, bytes.length, answers);
    }

    private static String speak(String id, String text) {
        return "{\"name\": \"android.speak\", \"data\": {\"text\": \"" + text + "\"}, \"id\": \""
                + id + "\"}";
    }

    private static byte[] bytes(String text) {
        return text.getBytes(Charset.forName("UTF-8"));
    }
}
