package org.raspilot.up.security;

import java.nio.charset.Charset;
import java.security.SecureRandom;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Random;
import org.raspilot.up.wire.BinaryLine;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.MalformedException;

/**
 * The client's end of one request to a runner under a key: a hello, then the request, in lines of
 * JSON. Source: docs/security.md, "Requests to a runner"; docs/protocols.md 8.
 */
public final class RunnerSession {
    /** The name of every runner, in the place of an aircraft's; no aircraft can have it. */
    private static final String RUNNER = "runner:";
    private static final String PROTECTED = "protected";
    private static final Charset UTF_8 = Charset.forName("UTF-8");

    private final GroundSession session;

    public RunnerSession(Pairing pairing) {
        this(pairing, GroundSession.seeded(new SecureRandom()));
    }

    /** Draws its nonce from {@code random}. */
    RunnerSession(Pairing pairing, Random random) {
        session = new GroundSession(RUNNER, pairing, random);
    }

    /** Returns the first line. */
    public String hello() {
        return toLine(session.hello());
    }

    /**
     * Returns the line with a request, which is JSON without its LF.
     *
     * @param answer the line of the answer to the hello
     * @throws EnvelopeException with the code of a refusal, or of an answer that proves nothing
     */
    public String request(String answer, String request) throws EnvelopeException {
        if (!isAnswer(body(answer))) {
            throw new EnvelopeException("malformed");
        }
        return toLine(session.seal(Hmac.ascii(request)));
    }

    /**
     * Returns the runner's answer to the request, JSON without its LF.
     *
     * @throws EnvelopeException as {@link #request}
     */
    public String result(String answer) throws EnvelopeException {
        final byte[] body = body(answer);
        final byte[] opened = isAnswer(body) ? null : session.open(body);
        if (opened == null) {
            throw new EnvelopeException("malformed");
        }
        return new String(opened, UTF_8);
    }

    private boolean isAnswer(byte[] body) throws EnvelopeException {
        final Handshake said =
                body[0] == BinaryLine.HANDSHAKE ? session.onHandshake(body) : null;
        if (said != null && said.refusal != null) {
            throw new EnvelopeException(said.refusal);
        }
        return said != null;
    }

    private static String toLine(byte[] body) {
        final Map<String, Object> line = new LinkedHashMap<>();
        line.put("action", PROTECTED);
        line.put("body", Pairing.digits(body));
        return Json.write(line) + "\n";
    }

    /** Returns the body in a line; a plain one is refused with the code in it. */
    private static byte[] body(String line) throws EnvelopeException {
        final Object said;
        try {
            said = Json.parse(line);
        } catch (MalformedException fault) {
            throw new EnvelopeException("malformed");
        }
        if (!(said instanceof Map)) {
            throw new EnvelopeException("malformed");
        }
        final Object code = ((Map<?, ?>) said).get("code");
        if (code instanceof String) {
            throw new EnvelopeException(
                    ((String) code).matches("[a-z_]{1,40}") ? (String) code : "malformed");
        }
        final Object body = ((Map<?, ?>) said).get("body");
        final String digits = body instanceof String ? (String) body : "";
        if (!digits.matches("[0-9a-f]+") || digits.length() % 2 != 0) {
            throw new EnvelopeException("unprotected");
        }
        return Pairing.bytes(digits);
    }
}
