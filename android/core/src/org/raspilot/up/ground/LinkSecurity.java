package org.raspilot.up.ground;

import java.util.Arrays;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.security.EnvelopeException;
import org.raspilot.up.security.GroundSession;
import org.raspilot.up.security.Handshake;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.wire.BinaryLine;

/**
 * The protected session on a link: hellos, renewal, and what {@link LinkStatus} shows of it.
 * Without a key lines are plain, and protected ones are counted.
 *
 * <p>Source: docs/security.md, docs/protocols.md 11.
 */
final class LinkSecurity {
    /** An answer that takes longer, ms, is void: the relay may have held it back. */
    static final long ANSWER_MS = 2000;
    /** Period of new sessions, ms, which compare the clocks again. */
    static final long RENEW_MS = 60000;

    private static final long SLOW_MS = 300;
    /** After an answer that took longer than that the clocks are compared again soon. */
    private static final long AGAIN_MS = 5000;
    private static final long LEAST_BETWEEN_MS = 1000;

    private final Loop loop;
    private final LinkStatus facts;
    private final GroundLink link;
    private final GroundSession session;
    private Cancellable timer = Cancellable.DONE;
    private boolean isStarted;
    private long sentMs;

    LinkSecurity(Loop loop, Pairing pairing, LinkStatus facts, GroundLink link) {
        this.loop = loop;
        this.facts = facts;
        this.link = link;
        session = pairing == null ? null : new GroundSession(pairing);
        facts.keyName = pairing == null ? "" : pairing.name;
    }

    void start() {
        if (session != null) {
            isStarted = true;
            hello();
        }
    }

    /** Ends with the connection: its session is not resumed. */
    void stop() {
        isStarted = false;
        timer.cancel();
        facts.keyRole = "";
    }

    /** Requests a new session, at most once a second. */
    void renew() {
        if (isStarted && loop.nowMs() - sentMs >= LEAST_BETWEEN_MS) {
            hello();
        }
    }

    /** Returns the protected line of a line with its LF; null without a session. */
    byte[] seal(byte[] line) {
        if (session == null) {
            return line;
        }
        return facts.keyRole.isEmpty() ? null
                : BinaryLine.toLine(session.seal(Arrays.copyOf(line, line.length - 1)));
    }

    /**
     * Returns what a body protects; null: a handshake, for others, or refused and counted.
     *
     * <p>With a key a plain body is refused: an attacker who can drop the protected ones could have
     * written it.
     */
    byte[] open(byte[] body) {
        final boolean isProtected =
                body[0] == BinaryLine.PROTECTED || body[0] == BinaryLine.SHORT;
        final boolean isPlain = !isProtected && body[0] != BinaryLine.HANDSHAKE;
        if (isPlain != (session == null)) {
            facts.unprotected++;
            return null;
        }
        if (isPlain) {
            return body;
        }
        try {
            if (isProtected) {
                return session.open(body);
            }
            onReply(session.onHandshake(body));
        } catch (EnvelopeException fault) {
            if (fault.code.equals("unknown_stream")) {
                // The aircraft has restarted, or drew a new key after a revocation.
                renew();
            } else {
                facts.refused++;
            }
        }
        return null;
    }

    private void hello() {
        sentMs = loop.nowMs();
        link.sendPlain(BinaryLine.toLine(session.hello()));
        schedule(ANSWER_MS, () -> {
            session.forgetHello();
            hello();
        });
    }

    private void onReply(Handshake said) {
        if (said == null) {
            return;
        }
        if (said.refusal != null) {
            facts.keyRole = "";
            facts.keyRefusal = said.refusal;
            session.forgetHello();
            schedule(said.refusal.equals("revoked") ? RENEW_MS : ANSWER_MS, () -> hello());
            return;
        }
        final long nowMs = loop.nowMs();
        facts.keyRole = said.role;
        facts.keyRefusal = "";
        schedule(nowMs - sentMs > SLOW_MS ? AGAIN_MS : RENEW_MS, () -> hello());
        link.onClock(said.clockMs, sentMs, nowMs);
    }

    private void schedule(long delayMs, Runnable call) {
        timer.cancel();
        timer = loop.schedule(delayMs, call);
    }
}
