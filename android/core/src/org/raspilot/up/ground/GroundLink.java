package org.raspilot.up.ground;

import java.util.Random;
import org.raspilot.up.ground.GroundStatus.LinkState;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.net.FixedEndpoint;
import org.raspilot.up.net.UpSocket;
import org.raspilot.up.net.UpSocketListener;
import org.raspilot.up.net.UpSocketSettings;
import org.raspilot.up.net.UpSocketStatus;
import org.raspilot.up.wire.BinaryLine;
import org.raspilot.up.wire.ControlLine;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.HelloAnswer;
import org.raspilot.up.wire.MalformedException;
import org.raspilot.up.wire.PackedTelemetry;
import org.raspilot.up.wire.ProxyRole;
import org.raspilot.up.wire.SafeText;

/**
 * The link to the aircraft: sends the hello, keeps the seat and its token, reconnects after losses.
 *
 * <p>Source: docs/protocols.md 9.
 */
final class GroundLink implements UpSocketListener {
    static final long HELLO_TIMEOUT_MS = 5000;
    /** By then, ms, a proxy has reported the owner of control; an aircraft itself never does. */
    static final long HOLDER_TOLD_MS = 1000;

    /** Minimum time between two requests for a key of packed telemetry, ms. */
    private static final long KEY_INTERVAL_MS = 500;
    private static final int CONNECT_TIMEOUT_MS = 5000;
    private static final int HEARTBEAT_MS = 1000;

    private final Loop loop;
    private final GroundSettings settings;
    private final LinkListener listener;
    private final UpSocket socket;
    private final LinkStatus facts = new LinkStatus();
    private final ControlLease claim;
    private final SilenceWatchdog quiet;
    private final LinkSecurity security;
    private final PackedTelemetry unpacker = new PackedTelemetry();
    private Long keyAskedMs;
    private boolean isGreeted;
    private long connectingMs;
    private long connectTookMs;
    private long helloMs;
    private Cancellable helloTimer = Cancellable.DONE;
    private UpSocketStatus judged;

    GroundLink(Loop loop, GroundSettings settings, TokenStore tokens, LinkListener listener,
            Random random) {
        this.loop = loop;
        this.settings = settings;
        this.listener = listener;
        claim = new ControlLease(settings, tokens, facts);
        quiet = new SilenceWatchdog(loop, facts, forMs -> drop(
                "silent", "nothing came for " + Math.round(forMs / 1000.0) + " s"));
        security = new LinkSecurity(loop, settings.pairing, facts, this);
        facts.isTls = settings.tls != null;
        final UpSocketSettings lines = UpSocketSettings.lines()
                .withConnectTimeoutMs(CONNECT_TIMEOUT_MS)
                .withTls(settings.tls);
        socket = new UpSocket(loop,
                new FixedEndpoint(new Endpoint(settings.host, settings.port, 0)), this,
                // A thesis peer does not support heartbeats.
                settings.isDirect ? lines : lines.withHeartbeatMs(HEARTBEAT_MS), random);
    }

    LinkStatus facts() {
        return facts;
    }

    /** Returns whether messages can go now. */
    boolean isOpen() {
        return facts.state == LinkState.OPEN;
    }

    void start() {
        if (facts.state != LinkState.STOPPED) {
            return;
        }
        claim.reset();
        facts.rejection = "";
        facts.enter(LinkState.CONNECTING, loop.nowMs(), "", "");
        socket.start();
        listener.onLink();
    }

    void stop() {
        if (facts.state != LinkState.STOPPED) {
            socket.stop();
            close(LinkState.STOPPED, "stopped", "stopped");
            listener.onLink();
        }
    }

    void reconnectNow() {
        socket.reconnectNow();
    }

    /**
     * Sends a message's line; returns false without a link or without the session that its key
     * requires, or when too much data waits.
     */
    boolean send(byte[] line) {
        final byte[] sealed = security.seal(line);
        return sealed != null && sendPlain(sealed);
    }

    /** Sends a line as it is. */
    boolean sendPlain(byte[] line) {
        return isOpen() && socket.send(line);
    }

    /** Takes the aircraft's clock, authentic and read between two times here, ms. */
    void onClock(double clockMs, long fromMs, long toMs) {
        listener.onClock(clockMs, fromMs, toMs);
    }

    private void drop(String code, String reason) {
        socket.drop(code, reason);
    }

    /** Called when the period of telemetry may change. */
    void expectAnotherPeriod() {
        quiet.expectAnotherPeriod();
    }

    boolean requestControl() {
        if (settings.isDirect || facts.state == LinkState.STOPPED) {
            return false;
        }
        claim.setWanted(ProxyRole.COMMAND);
        if (!isOpen()) {
            // Without a link the seat cannot be requested; the next hello requests it.
            return false;
        }
        final boolean isUntold = facts.role != ProxyRole.COMMAND && !facts.isOwnerKnown
                && loop.nowMs() - facts.sinceMs >= HOLDER_TOLD_MS;
        if (isUntold) {
            // Only a new hello gives the seat of an aircraft's own listener.
            return reconnectWithHello();
        }
        return sendPlain(ControlLine.seatRequest());
    }

    boolean giveControl(int to) {
        return ownsControl() && to >= 0 && sendPlain(ControlLine.seatGive(to));
    }

    boolean releaseControl() {
        if (!ownsControl()) {
            return false;
        }
        claim.setWanted(ProxyRole.LISTEN);
        if (!facts.isOwnerKnown) {
            claim.dropToken();
            return reconnectWithHello();
        }
        facts.isReleased = sendPlain(ControlLine.seatRelease());
        listener.onLink();
        return facts.isReleased;
    }

    @Override
    public void onConnected() {
        final long nowMs = loop.nowMs();
        connectTookMs = nowMs - connectingMs;
        quiet.start();
        isGreeted = settings.isDirect;
        if (isGreeted) {
            opened(connectTookMs);
            return;
        }
        helloMs = nowMs;
        helloTimer = loop.schedule(HELLO_TIMEOUT_MS, () -> {
            socket.drop("hello_timeout", "no answer to the hello within " + HELLO_TIMEOUT_MS / 1000
                    + " s: is this the ground port of a Ground Station Proxy?"
                    + " (a direct link says no hello)");
        });
        socket.send(claim.hello());
    }

    @Override
    public void onReceived(byte[] bytes, int length) {
        quiet.onLine();
        if (ControlLine.isControlLine(bytes, length)) {
            if (!isGreeted) {
                onHelloAnswer(HelloAnswer.read(bytes, length));
            } else if (!settings.isDirect) {
                onControl(ControlLine.read(bytes, length));
            }
        } else if (!isGreeted) {
            socket.drop("not_a_proxy", "the other side does not answer a hello: not a Ground"
                    + " Station Proxy of this version (a direct link says no hello)");
        } else {
            onLine(bytes, length);
        }
    }

    @Override
    public void onLost(String reason) {
        final boolean wasOpen = isOpen();
        final LinkState next =
                facts.state == LinkState.STOPPED ? LinkState.STOPPED : LinkState.WAITING;
        close(next, socket.status().code, reason);
        if (wasOpen) {
            listener.onLost(reason);
        }
    }

    @Override
    public void onStatus() {
        final UpSocketStatus status = socket.status();
        if (status == judged || facts.state == LinkState.STOPPED) {
            return;
        }
        judged = status;
        if (status.state == UpSocketStatus.State.WAITING) {
            if (facts.state != LinkState.WAITING) {
                close(LinkState.WAITING, status.code, status.sentence);
            }
        } else if (status.state == UpSocketStatus.State.CONNECTING
                || status.state == UpSocketStatus.State.FINDING) {
            connectingMs = loop.nowMs();
            facts.state = LinkState.CONNECTING;
        }
        listener.onLink();
    }

    private boolean ownsControl() {
        return isOpen() && facts.role == ProxyRole.COMMAND && !facts.isReleased;
    }

    private boolean reconnectWithHello() {
        socket.drop("role_changed", "another role is requested");
        socket.reconnectNow();
        return true;
    }

    private void onHelloAnswer(HelloAnswer answer) {
        if (answer == null || answer.role == ProxyRole.AIR) {
            return;
        }
        if (!answer.isAccepted()) {
            facts.rejection = answer.code;
            socket.drop("hello_refused", "the proxy refuses: "
                    + SafeText.of(answer.reason, 300) + " (" + answer.code + ")");
        } else {
            isGreeted = true;
            opened(Math.min(connectTookMs, loop.nowMs() - helloMs));
            claim.onAccepted(answer);
            listener.onOpened();
            listener.onLink();
        }
    }

    private void onControl(ControlLine said) {
        if (said != null) {
            claim.onControl(said);
            if (said.kind == ControlLine.Kind.AIRCRAFT_ONLINE) {
                security.renew();
            }
            listener.onLink();
        }
    }

    private void onLine(byte[] line, int length) {
        final GeneralMessage message;
        try {
            byte[] body = open(BinaryLine.toBody(line, length));
            if (body == null) {
                return;
            }
            if (body.length > 0 && body[0] == BinaryLine.PACKED) {
                body = unpacker.unpack(body);
            }
            message = GeneralMessage.read(body, body.length);
        } catch (MalformedException fault) {
            if (fault.code.equals(PackedTelemetry.UNKNOWN_KEY)) {
                requestKey();
            }
            return;
        }
        quiet.onMessage();
        listener.onMessage(message);
    }

    /** Returns the body as far as this device may take it; null: it may not. */
    private byte[] open(byte[] body) {
        final String before = facts.keyFault();
        final byte[] opened = security.open(body);
        if (!before.equals(facts.keyFault())) {
            listener.onLink();
        }
        return opened;
    }

    private void requestKey() {
        final long nowMs = loop.nowMs();
        if (keyAskedMs == null || nowMs - keyAskedMs >= KEY_INTERVAL_MS) {
            keyAskedMs = nowMs;
            sendPlain(ControlLine.keyRequest());
        }
    }

    private void opened(long roundTripMs) {
        helloTimer.cancel();
        facts.enter(LinkState.OPEN, loop.nowMs(), "", "");
        facts.roundTripMs = settings.isDirect ? null : Double.valueOf(roundTripMs);
        facts.rejection = "";
        security.start();
        if (settings.isDirect) {
            listener.onOpened();
            listener.onLink();
        }
    }

    private void close(LinkState state, String code, String reason) {
        helloTimer.cancel();
        quiet.stop();
        security.stop();
        isGreeted = false;
        facts.roundTripMs = null;
        facts.enter(state, loop.nowMs(), code, reason);
    }

    /** Receives the events and messages of a {@link GroundLink}. */
    interface LinkListener {
        /** Takes a message from the aircraft. */
        void onMessage(GeneralMessage message);

        /** Takes the aircraft's clock, authentic and read between two times here, ms. */
        void onClock(double clockMs, long fromMs, long toMs);

        /** Called when the link is open: messages can be sent. */
        void onOpened();

        void onLost(String reason);

        /** Called when a part of the link's state has changed. */
        void onLink();
    }
}
