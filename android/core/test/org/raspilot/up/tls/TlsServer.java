package org.raspilot.up.tls;

import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import javax.net.ssl.SSLEngine;
import javax.net.ssl.SSLEngineResult.HandshakeStatus;
import javax.net.ssl.SSLException;
import org.raspilot.up.loop.ScriptedNetwork;

/** The server's end of TLS in memory, on a connection of a test. */
final class TlsServer {
    private static final int RECORD_BYTES = 65536;

    final ByteArrayOutputStream heard = new ByteArrayOutputStream();
    private final SSLEngine engine;
    private final ScriptedNetwork.Connection peer;
    private final ByteBuffer wire = ByteBuffer.allocate(1 << 20);

    TlsServer(TlsIdentity identity, ScriptedNetwork.Connection peer) throws Exception {
        this.peer = peer;
        engine = identity.engine("client", 1, identity.trust("client"));
        engine.setUseClientMode(false);
    }

    /** Speaks this version alone. */
    void speak(String version) {
        engine.setEnabledProtocols(new String[] {version});
    }

    boolean isInboundDone() {
        return engine.isInboundDone();
    }

    /** Takes what the client wrote, and answers what TLS requires; returns whether any moved. */
    boolean pump() throws SSLException {
        final byte[] came = peer.writtenBytes();
        wire.put(came).flip();
        boolean isMoving = true;
        boolean hasMoved = came.length > 0;
        while (isMoving) {
            isMoving = false;
            final HandshakeStatus next = engine.getHandshakeStatus();
            if (next == HandshakeStatus.NEED_TASK) {
                engine.getDelegatedTask().run();
                isMoving = true;
            } else if (next == HandshakeStatus.NEED_WRAP) {
                isMoving = say(new byte[0]) > 0;
            } else if (wire.hasRemaining()) {
                final ByteBuffer plain = ByteBuffer.allocate(RECORD_BYTES);
                isMoving = engine.unwrap(wire, plain).bytesConsumed() > 0;
                heard.write(plain.array(), 0, plain.position());
            }
            hasMoved |= isMoving;
        }
        wire.compact();
        return hasMoved;
    }

    /** Sends data to the client in one record; returns its size. */
    int say(byte[] plain) throws SSLException {
        final byte[] record = record(plain);
        if (record.length > 0 && !peer.isClosed) {
            peer.listener.onBytes(record, record.length);
        }
        return record.length;
    }

    byte[] record(byte[] plain) throws SSLException {
        final ByteBuffer record = ByteBuffer.allocate(RECORD_BYTES);
        engine.wrap(ByteBuffer.wrap(plain), record);
        return java.util.Arrays.copyOf(record.array(), record.position());
    }

    /** Tells the client the end. */
    void end() throws SSLException {
        engine.closeOutbound();
        say(new byte[0]);
    }
}
