package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNotEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.util.Collections;
import java.util.Locale;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.ProxyRole;

/** When a Command is sent, with which beacon, and what its answer is. */
public final class GroundCommandsTest {
    @Rule
    public final GroundBench bench = new GroundBench();

    private Long shown;

    private void send(BaseCommand command) {
        bench.ground.send(command, shown, bench.keeping());
    }

    private void flySeen(long firstBeacon, int count) {
        shown = bench.fly(firstBeacon, count);
        bench.skipGains();
    }

    private void mustBeRefused(String code) {
        final Answer answer = bench.answer();
        assertEquals(Answer.Outcome.REFUSED, answer.outcome);
        assertEquals(code, answer.code);
        assertTrue(bench.sent().isEmpty());
    }

    @Test
    public void itGoesOutOnceWithAnIdAndTheBeaconThatThePilotHasSeen() {
        bench.open(ProxyRole.COMMAND);
        flySeen(40, 3);
        bench.loop.advance(100);
        bench.frame(43, "{}");
        send(Commands.flightMode("FBW"));
        final GeneralMessage sent = bench.sent(Commands.FLIGHT_MODE);
        assertEquals("drawn was 42", Long.valueOf(42), sent.beacon);
        assertEquals("FBW", sent.data.get("mode"));
        bench.loop.advance(120);
        bench.ack(sent.id);
        final Answer answer = bench.answer();
        assertEquals(Answer.Outcome.ACK, answer.outcome);
        assertEquals(Long.valueOf(120), answer.roundTripMs);
        assertEquals(Commands.FLIGHT_MODE, answer.name);
        assertTrue(bench.events().contains("command_ack"));
        bench.loop.advance(5000);
        assertTrue(bench.sent().isEmpty());
    }

    @Test
    public void itsIdIsTheSameOnAPhoneThatWritesOtherDigits() {
        final Locale before = Locale.getDefault();
        Locale.setDefault(new Locale("ar", "EG"));
        try {
            bench.open(ProxyRole.COMMAND);
            flySeen(1, 1);
            send(new BaseCommand(Commands.DISARM));
            final String id = bench.sent(Commands.DISARM).id;
            assertTrue(id, id.matches("[0-9a-f]{16}-[0-9]+"));
        } finally {
            Locale.setDefault(before);
        }
    }

    @Test
    public void aBeaconThatWasSeenTooLongAgoIsNotEchoed() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 1);
        bench.fly(2, 20);
        send(new BaseCommand(Commands.DISARM));
        assertEquals(Long.valueOf(1), bench.sent(Commands.DISARM).beacon);
        bench.fly(22, 1);
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("stale");
    }

    @Test
    public void aBeaconStaysFreshForASlowPeriod() {
        bench.open(ProxyRole.COMMAND);
        bench.frame(1, "{\"system\": {\"period_ms\": 10000}}");
        shown = 1L;
        bench.loop.advance(10999);
        send(new BaseCommand(Commands.DISARM));
        assertEquals(Long.valueOf(1), bench.sent(Commands.DISARM).beacon);
        bench.loop.advance(2);
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("stale");
    }

    @Test
    public void theHoldUpOnTheWayCountsForTheBeaconToo() {
        bench.open(ProxyRole.COMMAND);
        bench.frame(1, "{\"system\": {\"clock_ms\": 0}}");
        bench.loop.advance(1600);
        bench.frame(2, "{\"system\": {\"clock_ms\": 100}}");
        shown = 2L;
        bench.loop.advance(499);
        send(new BaseCommand(Commands.DISARM));
        assertEquals(Long.valueOf(2), bench.sent(Commands.DISARM).beacon);
        bench.loop.advance(3);
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("stale");
    }

    @Test
    public void nobodyCommandsWhatTheyHaveNotSeen() {
        bench.open(ProxyRole.COMMAND);
        bench.fly(1, 3);
        bench.skipGains();
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("no_beacon");
        shown = 78L;
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("stale");
        shown = 2L;
        send(new BaseCommand(Commands.DISARM));
        assertEquals(Long.valueOf(2), bench.sent(Commands.DISARM).beacon);
    }

    @Test
    public void withoutTheSeatNothingIsSent() {
        bench.open(ProxyRole.LISTEN);
        flySeen(1, 3);
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("no_control");
        bench.say("UP1 seat command token=" + GroundBench.TOKEN);
        send(new BaseCommand(Commands.DISARM));
        bench.sent(Commands.DISARM);
        bench.say("UP1 seat listen");
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("no_control");
    }

    @Test
    public void withoutALinkOrAnAircraftNothingIsSentNorKeptForLater() {
        bench.start(GroundBench.settings(ProxyRole.COMMAND, false));
        send(new BaseCommand(Commands.DISARM));
        assertEquals("no_link", bench.answer().code);
        bench.accept(ProxyRole.COMMAND);
        bench.say("UP1 aircraft offline");
        flySeen(1, 3);
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("no_aircraft");
        bench.peer().end("gone");
        send(new BaseCommand(Commands.DISARM));
        assertEquals("not connected: gone", bench.answer().reason);
        bench.loop.advance(700);
        bench.accept(ProxyRole.COMMAND);
        flySeen(4, 3);
        assertFalse(bench.peer().written().contains("disarm"));
    }

    @Test
    public void whatWasSeenOnTheLastConnectionCountsForNothing() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        bench.peer().end("lost");
        bench.loop.advance(700);
        bench.accept(ProxyRole.COMMAND);
        send(new BaseCommand(Commands.ARM));
        mustBeRefused("stale");
    }

    @Test
    public void armingNeedsABeaconEvenWhereTheAircraftHasNone() {
        bench.open(ProxyRole.COMMAND);
        bench.say("{\"name\": \"up.telemetry.update\", \"data\": {}}");
        send(Commands.flightMode("FBW"));
        assertNull(bench.sent(Commands.FLIGHT_MODE).beacon);
        for (BaseCommand command : new BaseCommand[] {new BaseCommand(Commands.ARM),
                new BaseCommand(Commands.DISARM)}) {
            send(command);
            mustBeRefused("no_beacon");
        }
    }

    @Test
    public void theAnswerOfAnotherIdIsNotTaken() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        send(new BaseCommand(Commands.DISARM));
        final String id = bench.sent(Commands.DISARM).id;
        bench.ack("another");
        bench.say("{\"name\": \"up.ack\", \"data\": {\"id\": 5}}");
        bench.say("{\"name\": \"up.ack\", \"data\": {}}");
        assertTrue(bench.answers.isEmpty());
        bench.nack(id, "refused", "transmitter\\u0007");
        final Answer answer = bench.answer();
        assertEquals(Answer.Outcome.NACK, answer.outcome);
        assertEquals("refused transmitter", answer.code + " " + answer.reason);
        bench.ack(id);
        assertTrue(bench.answers.isEmpty());
    }

    @Test
    public void idsAreDifferentAndAnswersFindTheirs() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        send(new BaseCommand(Commands.DISARM));
        final String first = bench.sent(Commands.DISARM).id;
        send(Commands.flightMode("RATE"));
        final String second = bench.sent(Commands.FLIGHT_MODE).id;
        assertNotEquals(first, second);
        bench.ack(second);
        assertEquals(Commands.FLIGHT_MODE, bench.answer().name);
        bench.ack(first);
        assertEquals(Commands.DISARM, bench.answer().name);
    }

    @Test
    public void noAnswerForThreeSecondsIsATimeoutAndIsNotRepaired() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        send(new BaseCommand(Commands.DISARM));
        final String id = bench.sent(Commands.DISARM).id;
        bench.loop.advance(2999);
        assertTrue(bench.answers.isEmpty());
        bench.loop.advance(1);
        final Answer answer = bench.answer();
        assertEquals(Answer.Outcome.TIMEOUT, answer.outcome);
        bench.ack(id);
        assertTrue(bench.answers.isEmpty());
        assertTrue(bench.sent().isEmpty());
    }

    @Test
    public void aLostLinkEndsTheWaiting() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        send(new BaseCommand(Commands.DISARM));
        bench.peer().end("lost");
        assertEquals("link_lost", bench.answer().code);
        bench.loop.advance(700);
        bench.accept(ProxyRole.COMMAND);
        bench.loop.advance(5000);
        assertTrue(bench.sent().isEmpty());
        assertTrue(bench.answers.isEmpty());
    }

    @Test
    public void stoppingEndsTheWaitingToo() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        send(new BaseCommand(Commands.DISARM));
        bench.ground.stop();
        assertEquals("link_lost", bench.answer().code);
    }

    @Test
    public void tooManyThatWaitAreRefused() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        for (int each = 0; each < PendingCommands.MAX_WAITING; each++) {
            send(new BaseCommand(Commands.DISARM));
        }
        assertTrue(bench.answers.isEmpty());
        bench.sent();
        send(new BaseCommand(Commands.DISARM));
        mustBeRefused("busy");
    }

    @Test
    public void whatNoLineCanHoldIsRefused() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        send(new BaseCommand("x.y", Collections.singletonMap("v", Double.NaN)));
        mustBeRefused("invalid");
        send(new BaseCommand("x.y", Collections.singletonMap("v",
                new String(new char[20000]).replace('\0', 'v'))));
        mustBeRefused("invalid");
    }

    @Test
    public void anyCommandOfTheCatalogueCanBeSentByItsName() {
        bench.open(ProxyRole.COMMAND);
        flySeen(1, 3);
        send(new BaseCommand("new.cog.command", Collections.singletonMap("v", 5L)));
        assertEquals(5L, bench.sent("new.cog.command").data.get("v"));
    }

    @Test
    public void whatTheProfileRequestAsksForIsItsAnswersData() {
        bench.open(ProxyRole.COMMAND);
        bench.fly(1, 1);
        bench.sent();
        send(new BaseCommand("arduino.profile.request", null));
        final String id = bench.sent("arduino.profile.request").id;
        bench.ack(id);
        assertTrue(bench.answers.isEmpty());
        bench.say("{\"name\": \"arduino.profile.values\", \"data\": {\"mix\": \"elevon\"}}");
        assertEquals("elevon", bench.answer().data.get("mix"));
    }
}
