package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNotNull;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.GainSet.Gains;
import org.raspilot.up.commands.GainSet.LoopGains;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.ProxyRole;

/** Gains: requested, stored, set whole, undone. */
public final class GainsServiceTest {
    @Rule
    public final GroundBench bench = new GroundBench();

    static GainSet set(double rateRollP) {
        final LoopGains loop = new LoopGains(new Gains(2, 0.1, 0.02), new Gains(2, 0.1, 0.02),
                new Gains(1, 0, 0));
        return new GainSet(new LoopGains(new Gains(rateRollP, 0.5, 0.25), new Gains(3, 0.5, 0.25),
                new Gains(1, 0, 0)), loop);
    }

    private void flyWith(GainSet flying) {
        bench.open(ProxyRole.COMMAND);
        bench.fly(1, 1);
        answerRequest(flying);
    }

    private void answerRequest(GainSet flying) {
        final GeneralMessage asked = bench.sent(Commands.PIDS);
        assertEquals(true, asked.data.get("request"));
        bench.say(new String(new GeneralMessage("arduino.pids.values", flying.toData()).toLine(),
                ScriptedNetwork.UTF_8).trim());
        bench.ack(asked.id);
    }

    private GeneralMessage setGains(GainSet gains) {
        bench.ground.gains().set(gains, 1L, bench.keeping());
        return bench.sent(Commands.PIDS);
    }

    private Double flyingP() {
        return GainKey.ALL.get(0).of(bench.ground.gains().snapshot().flying);
    }

    @Test
    public void theyAreAskedForAsSoonAsTheSeatAndTelemetryAreHere() {
        bench.open(ProxyRole.LISTEN);
        bench.fly(1, 3);
        assertTrue(bench.sent().isEmpty());
        bench.say("UP1 seat command token=" + GroundBench.TOKEN);
        bench.fly(4, 1);
        assertNull(flyingP());
        answerRequest(set(3));
        assertEquals(3, flyingP(), 0);
        assertEquals(Long.valueOf(bench.loop.nowMs()),
                bench.ground.gains().snapshot().reportedMs);
        bench.fly(5, 20);
        assertTrue("asked once", bench.sent().isEmpty());
    }

    @Test
    public void aQuestionOfThePilotIsAnsweredWithTheGains() {
        flyWith(set(3));
        bench.ground.gains().request(bench.keeping());
        answerRequest(set(4));
        final Answer answer = bench.answer();
        assertTrue(answer.isAck());
        assertNotNull(answer.data.get("ratePIDs"));
        assertEquals(4, flyingP(), 0);
    }

    @Test
    public void aSetIsSentWholeAndRemembered() {
        flyWith(set(3));
        final long version = bench.ground.gains().version();
        final GeneralMessage sent = setGains(set(2.5));
        assertEquals(Long.valueOf(1), sent.beacon);
        assertEquals(Json.write(Collections.singletonMap("pids", set(2.5).toData())),
                Json.write(sent.data));
        bench.ack(sent.id);
        assertTrue(bench.answer().isAck());
        final GainsService.Snapshot now = bench.ground.gains().snapshot();
        assertTrue(now.version > version);
        assertEquals(1, now.history.size());
        assertEquals("[rate roll P 3 to 2.5]", now.history.get(0).changes().toString());
        assertTrue(bench.events().contains("gains_ack"));
        bench.fly(2, 1);
        answerRequest(set(2.5));
        assertEquals(2.5, flyingP(), 0);
    }

    @Test
    public void undoSetsWhatFlewBeforeStepByStep() {
        flyWith(set(3));
        bench.ack(setGains(set(2)).id);
        bench.fly(2, 1);
        answerRequest(set(2));
        bench.ack(setGains(set(1)).id);
        bench.fly(3, 1);
        answerRequest(set(1));
        bench.answers.clear();
        bench.ground.gains().undo(1L, bench.keeping());
        final GeneralMessage first = bench.sent(Commands.PIDS);
        assertEquals(Json.write(set(2).toData()), Json.write(first.data.get("pids")));
        bench.nack(first.id, "forbidden", "armed");
        bench.answer();
        bench.ground.gains().undo(1L, bench.keeping());
        final GeneralMessage again = bench.sent(Commands.PIDS);
        assertEquals(first.data, again.data);
        bench.ack(again.id);
        bench.answer();
        bench.ground.gains().undo(1L, bench.keeping());
        final GeneralMessage second = bench.sent(Commands.PIDS);
        assertEquals(Json.write(set(3).toData()), Json.write(second.data.get("pids")));
        bench.ack(second.id);
        bench.answer();
        assertNull(bench.ground.gains().snapshot().undo);
        bench.ground.gains().undo(1L, bench.keeping());
        assertEquals("invalid", bench.answer().code);
        assertEquals(5, bench.ground.gains().snapshot().history.size());
    }

    @Test
    public void aTimeoutLeavesOpenWhatFliesSoItIsAskedAgain() {
        flyWith(set(3));
        setGains(set(9));
        bench.loop.advance(3000);
        assertEquals(Answer.Outcome.TIMEOUT, bench.answer().outcome);
        assertEquals(3, flyingP(), 0);
        assertNull(bench.ground.gains().snapshot().undo);
        bench.fly(2, 1);
        answerRequest(set(9));
        assertEquals(9, flyingP(), 0);
    }

    @Test
    public void whatIsPartialOrOutOfRangeIsNotSent() {
        flyWith(set(3));
        for (double wrong : new double[] {50.001, -0.1, Double.NaN, Double.POSITIVE_INFINITY}) {
            refused(set(wrong), "ratePIDs.ailerons.p");
        }
        final LoopGains whole = set(3).rate;
        final LoopGains noRudder = new LoopGains(whole.ailerons, whole.elevator, null);
        refused(new GainSet(whole, noRudder), "pids");
        assertTrue(bench.ground.gains().snapshot().history.isEmpty());
        setGains(new GainSet(noRudder, noRudder));
    }

    private void refused(GainSet gains, String place) {
        bench.ground.gains().set(gains, 1L, bench.keeping());
        final Answer answer = bench.answer();
        assertEquals(Answer.Outcome.REFUSED, answer.outcome);
        assertEquals("invalid", answer.code);
        assertTrue(answer.reason, answer.reason.startsWith(place + " "));
        assertTrue(bench.sent().isEmpty());
    }

    @Test
    public void theGeneralWayOfSendingTakesNoPartialSetEither() {
        flyWith(set(3));
        final Map<String, Object> pids = new LinkedHashMap<>(set(3).toData());
        pids.remove("stabPIDs");
        for (Object each : new Object[] {pids, "all", null}) {
            bench.ground.send(new BaseCommand(Commands.PIDS,
                    Collections.singletonMap("pids", each)), 1L, bench.keeping());
            assertEquals("invalid", bench.answer().code);
        }
        assertTrue(bench.sent().isEmpty());
        bench.ground.send(Commands.pids(set(2)), 1L, bench.keeping());
        bench.ack(bench.sent(Commands.PIDS).id);
        bench.answer();
        assertEquals(3, GainKey.ALL.get(0).of(bench.ground.gains().snapshot().undo), 0);
    }

    @Test
    public void withoutTheSeatNoGainsAreSent() {
        bench.open(ProxyRole.LISTEN);
        bench.fly(1, 1);
        bench.ground.gains().set(set(3), 1L, bench.keeping());
        assertEquals("no_control", bench.answer().code);
        bench.ground.gains().request(bench.keeping());
        assertEquals("no_control", bench.answer().code);
        assertTrue(bench.sent().isEmpty());
    }

    @Test
    public void whatTheAircraftTellsAndIsNoSetIsNotHeld() {
        flyWith(set(3));
        bench.say("{\"name\": \"arduino.pids.values\", \"data\": {\"ratePIDs\": 5}}");
        bench.say("{\"name\": \"arduino.pids.values\", \"data\": {}}");
        assertEquals(3, flyingP(), 0);
        assertTrue(bench.events().contains("gains_invalid"));
    }

    @Test
    public void theSinglePrecisionOfTheBoardIsNoDifference() {
        assertTrue(GainsService.difference(set(2.4f), set(2.4)).isEmpty());
        assertEquals("[rate roll P 2.4 to 2.41]",
                GainsService.difference(set(2.4f), set(2.41)).toString());
        assertEquals(18, GainsService.difference(null, set(3)).size());
        assertEquals("rate roll P 3", GainsService.difference(null, set(3)).get(0).toString());
        assertFalse(GainsService.difference(set(0), set(1e-3)).isEmpty());
    }
}
