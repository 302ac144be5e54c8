package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.GroundStatus.LinkState;
import org.raspilot.up.wire.ProxyRole;

/** Hello, seat and token, and how the link comes back (docs/protocols.md 9). */
public final class GroundLinkTest {
    @Rule
    public final GroundBench bench = new GroundBench();

    @Test
    public void theHelloIsTheFirstLineAndItsAnswerOpensTheLink() {
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        assertEquals("192.0.2.9", bench.peer().host);
        assertEquals(3004, bench.peer().port);
        bench.peer().accept();
        bench.loop.advance(0);
        assertEquals("UP1 aircraft=glider seat=listen packed=1 attitude=1\n", bench.peer().written());
        assertEquals(LinkState.CONNECTING, bench.ground.status().link);
        bench.say("UP1 ok aircraft=glider seat=listen token=" + GroundBench.TOKEN);
        assertEquals(LinkState.OPEN, bench.status.link);
        assertEquals(ProxyRole.LISTEN, bench.status.role);
        assertEquals(ControlStatus.LATER, bench.status.control);
        assertNull(bench.tokens.load(bench.settings.tokenKey()));
    }

    @Test
    public void theTokenOfTheSeatIsSaidAtTheNextConnectionAndAtTheNextStart() {
        bench.open(ProxyRole.COMMAND);
        bench.peer().written();
        bench.peer().end("the network is gone");
        bench.loop.advance(700);
        bench.peer().accept();
        final String hello =
                "UP1 aircraft=glider seat=command token=" + GroundBench.TOKEN + " packed=1 attitude=1\n";
        assertEquals(hello, bench.peer().written());
        bench.ground.stop();
        bench.start(GroundBench.settings(ProxyRole.COMMAND, false));
        bench.peer().accept();
        assertEquals(hello, bench.peer().written());
    }

    @Test
    public void whoLosesTheSeatAsksForItNoMoreAndForgetsTheToken() {
        bench.open(ProxyRole.COMMAND);
        bench.say("UP1 seat listen");
        bench.say("UP1 seat holder=4");
        assertEquals(ControlStatus.HELD, bench.status.control);
        assertEquals("ground 4 commands", bench.status.controlText());
        assertNull(bench.tokens.load(bench.settings.tokenKey()));
        bench.peer().end("lost");
        bench.loop.advance(700);
        bench.peer().accept();
        assertEquals("UP1 aircraft=glider seat=listen packed=1 attitude=1\n", bench.peer().written());
    }

    @Test
    public void theSeatIsAskedForGivenAndReleased() {
        bench.open(ProxyRole.LISTEN);
        bench.peer().written();
        assertEquals(ControlStatus.FREE, bench.status.control);
        assertFalse(bench.ground.giveControl(2));
        assertFalse(bench.ground.releaseControl());
        assertTrue(bench.ground.requestControl());
        assertEquals("UP1 seat request\n", bench.peer().written());
        bench.say("UP1 seat command token=" + GroundBench.OTHER_TOKEN);
        bench.say("UP1 seat holder=2");
        assertEquals(ControlStatus.OURS, bench.status.control);
        assertEquals(GroundBench.OTHER_TOKEN, bench.tokens.load(bench.settings.tokenKey()));
        bench.say("UP1 seat asked by=5");
        assertEquals(Integer.valueOf(5), bench.status.requestedBy);
        assertTrue(bench.status.controlText().contains("ground 5"));
        assertTrue(bench.ground.giveControl(5));
        assertEquals("UP1 seat give to=5\n", bench.peer().written());
        assertEquals(ControlStatus.OURS, bench.status.control);
        assertTrue(bench.ground.releaseControl());
        assertEquals("UP1 seat release\n", bench.peer().written());
        assertEquals(ControlStatus.LATER, bench.status.control);
        bench.ground.send(new BaseCommand(Commands.DISARM), null, bench.keeping());
        assertEquals("no_control", bench.answer().code);
        bench.say("UP1 seat listen");
        bench.say("UP1 seat holder=none");
        assertEquals(ControlStatus.FREE, bench.status.control);
    }

    @Test
    public void aListenerThatIsNeverToldWhoCommandsAsksByANewHello() {
        // An aircraft's own listener knows the hello and no seat words.
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        bench.accept(ProxyRole.LISTEN);
        bench.loop.advance(1000);
        assertTrue(bench.ground.requestControl());
        assertEquals(2, bench.network.connections.size());
        bench.peer().accept();
        assertEquals("UP1 aircraft=glider seat=command packed=1 attitude=1\n", bench.peer().written());
    }

    @Test
    public void anotherSideThatAnswersNoHelloIsToldInASentence() {
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        bench.peer().accept();
        bench.say("{\"name\": \"up.telemetry.update\", \"data\": {}}");
        assertEquals(LinkState.WAITING, bench.status.link);
        assertEquals("not_a_proxy", bench.status.code);
        assertTrue(bench.frames.isEmpty());
        bench.loop.advance(700);
        bench.peer().accept();
        bench.loop.advance(4999);
        assertFalse(bench.peer().isClosed);
        bench.loop.advance(1);
        assertTrue(bench.peer().isClosed);
        assertEquals("hello_timeout", bench.status.code);
    }

    @Test
    public void aRefusedHelloIsToldWithTheProxysReason() {
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        bench.peer().accept();
        bench.say("UP1 error code=full reason=\"no room\"");
        assertEquals("full", bench.status.rejection);
        assertEquals("hello_refused", bench.status.code);
        assertTrue(bench.status.reason.contains("no room (full)"));
        assertTrue(bench.peer().isClosed);
        bench.loop.advance(700);
        bench.accept(ProxyRole.LISTEN);
        bench.loop.advance(0);
        assertEquals("", bench.status.rejection);
    }

    @Test
    public void nobodyWhoListensThereIsToldToo() {
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        bench.peer().end("cannot reach 192.0.2.9:3004: connection refused");
        bench.loop.advance(0);
        assertEquals(LinkState.WAITING, bench.status.link);
        assertTrue(bench.status.linkText().contains("connection refused"));
    }

    @Test
    public void anEmptyLineGoesOutInEachSecondInWhichNothingElseDid() {
        bench.open(ProxyRole.COMMAND);
        bench.peer().written();
        bench.loop.advance(3000);
        assertEquals("\n\n\n", bench.peer().written());
    }

    @Test
    public void aDirectLinkSaysNothingOfItself() {
        bench.start(GroundBench.settings(ProxyRole.COMMAND, true));
        bench.peer().accept();
        bench.loop.advance(5000);
        assertEquals("", bench.peer().written());
        assertEquals(LinkState.OPEN, bench.status.link);
        assertEquals(ControlStatus.OURS, bench.status.control);
        bench.say("UP1 seat listen");
        assertEquals(ControlStatus.OURS, bench.status.control);
        assertFalse(bench.ground.requestControl());
    }

    @Test
    public void halfALineOfTheOldConnectionIsNoBeginningOfTheNewOne() {
        bench.open(ProxyRole.LISTEN);
        bench.peer().say("{\"name\": \"up.telemetry.update\", \"data\": {\"altitude\"");
        bench.peer().end("lost");
        bench.loop.advance(700);
        bench.accept(ProxyRole.LISTEN);
        bench.say(": 5}}");
        bench.frame(1, "{\"altitude\": 7}");
        assertEquals(1, bench.frames.size());
        assertEquals(7.0, bench.frames.get(0).number("altitude"), 0);
    }

    @Test
    public void linesThatSayNothingKnownAreDropped() {
        bench.open(ProxyRole.LISTEN);
        bench.say("UP1 seat");
        bench.say("UP1 ok aircraft=glider seat=command token=" + GroundBench.TOKEN);
        bench.say("UP1 seat give to=3");
        bench.say("not JSON");
        bench.say("[1]");
        final StringBuilder tooLong = new StringBuilder();
        while (tooLong.length() < 20000) {
            tooLong.append("aaaaaaaaaa");
        }
        bench.say(tooLong.toString());
        assertTrue(bench.frames.isEmpty());
        assertEquals(ProxyRole.LISTEN, bench.ground.status().role);
    }

    @Test
    public void aSilentLinkIsGivenUpAfterAFewOfItsOwnPeriods() {
        bench.open(ProxyRole.COMMAND);
        bench.fly(1, 20);
        bench.loop.advance(3999);
        assertFalse(bench.peer().isClosed);
        bench.loop.advance(1);
        assertTrue(bench.peer().isClosed);
        assertEquals("silent", bench.status.code);
    }

    @Test
    public void slowTelemetryIsNoDeadLink() {
        bench.open(ProxyRole.COMMAND);
        for (int each = 0; each < 20; each++) {
            bench.loop.advance(10000);
            bench.frame(each, "{}");
        }
        assertEquals(1, bench.network.connections.size());
        bench.loop.advance(12000);
        assertEquals("silent", bench.status.code);
    }

    @Test
    public void whereTheAircraftIsAwayNothingHasToComeForLong() {
        bench.open(ProxyRole.LISTEN);
        bench.fly(1, 20);
        bench.say("UP1 aircraft offline");
        bench.loop.advance(29000);
        assertEquals(false, bench.status.isAircraftOnline);
        bench.loop.advance(5000);
        assertEquals(2, bench.network.connections.size());
    }

    @Test
    public void stoppedItIsStoppedUntilItIsStartedAgain() {
        bench.open(ProxyRole.LISTEN);
        bench.ground.stop();
        bench.ground.stop();
        assertTrue(bench.peer().isClosed);
        assertEquals("stopped", bench.status.linkText());
        bench.loop.advance(60000);
        assertEquals(1, bench.network.connections.size());
        bench.ground.start();
        bench.ground.start();
        assertEquals(2, bench.network.connections.size());
    }

    @Test
    public void thePhonesNetworkComesBackAndItTriesAtOnce() {
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        bench.peer().end("no network");
        bench.ground.reconnectNow();
        assertEquals(2, bench.network.connections.size());
    }
}
