package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import org.junit.After;
import org.junit.Test;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.loop.ScriptedNetwork;

/** In which mode orientation leaves the phone, and how (thesis 4.2.3). */
public final class AirborneOrientationTest {
    private final AirborneBench bench = new AirborneBench();

    @After
    public void nothingThrew() {
        bench.faults.mustBeNone();
    }

    @Test
    public void inFlightControllerModeItIsOff() {
        for (OrientationTransport transport : OrientationTransport.values()) {
            AirborneBench other = new AirborneBench();
            other.connected(AirborneBench.fixed().orientation(transport).build());
            other.fly(20, 2000);
            assertEquals(1, other.network.connections.size());
            assertEquals(0, other.network.ports.size());
            assertEquals(0, other.airborne.status().orientationHz(), 0);
            assertEquals(0, other.gyroscope.periodsMs.size());
        }
    }

    @Test
    public void inFlightControllerModeItLeavesWhereRedundancyIsWanted() {
        bench.connected(AirborneBench.fixed().redundantOrientation(true).build());
        bench.accept(50000);
        bench.fly(20, 2000);
        assertEquals(50, bench.airborne.status().orientationHz(), 1);
    }

    @Test
    public void inBlackBoxModeItLeavesByTcp() {
        bench.connected(AirborneBench.blackBox().build());
        bench.accept(50000);
        bench.fly(20, 2000);
        assertEquals(100, bench.frames(), 2);
    }

    @Test
    public void itLeavesByUdpWhereThatIsChosen() {
        bench.connected(AirborneBench.blackBox().orientation(OrientationTransport.UDP).build());
        bench.fly(20, 2000);
        assertEquals(1, bench.network.connections.size());
        assertEquals(100, bench.datagrams().size(), 1);
        assertTrue(bench.datagrams().get(0).endsWith(" -> 10.0.0.1:50000"));
    }

    @Test
    public void itsOwnConnectionMayBeLostAloneAndNothingOldComesAfter() {
        bench.connected(AirborneBench.blackBox().build());
        bench.accept(50000).end("gone");
        bench.fly(20, 1000);
        bench.loop.advance(5000);
        bench.accept(50000);
        assertEquals(0, bench.frames());
        bench.fly(20, 1000);
        assertEquals(50, bench.frames(), 1);
        assertTrue(bench.airborne.status().isConnected);
    }

    @Test
    public void afterAGapItsConnectionIsMadeAnewTogetherWithTheOther() {
        bench.connected(AirborneBench.blackBox().build());
        ScriptedNetwork.Connection first = bench.accept(50000);
        // A black hole that still has room: it accepts frames that never arrive.
        bench.fly(20, 1000);
        bench.general().end("gone");
        bench.loop.advance(1000);
        bench.accept(50001);
        assertTrue(first.isClosed);
        ScriptedNetwork.Connection second = bench.accept(50000);
        assertTrue(second != first);
        bench.fly(20, 1000);
        assertEquals(50, bench.frames(), 1);
    }

    @Test
    public void onAStalledConnectionTheNewestFrameWins() {
        bench.connected(AirborneBench.blackBox().build());
        ScriptedNetwork.Connection orientation = bench.accept(50000);
        orientation.room = 10;
        bench.fly(20, 1000);
        orientation.makeRoom(AirborneBench.ROOM - 10);
        bench.loop.advance(0);
        assertEquals(2, bench.frames());
    }
}
