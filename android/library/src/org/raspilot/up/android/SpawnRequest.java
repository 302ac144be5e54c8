package org.raspilot.up.android;

import java.util.concurrent.ArrayBlockingQueue;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.TimeUnit;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;
import org.raspilot.up.net.RunnerAnswer;
import org.raspilot.up.net.RunnerClient;
import org.raspilot.up.net.RunnerRequest;

/** One request to a runner, waited for on a thread that may wait. */
final class SpawnRequest {
    /** Longer than the runner's own 20 s. */
    private static final long MAX_S = 30;

    private final String host;
    private final int port;
    private final String aircraft;
    private final String profile;

    SpawnRequest(String host, int port, String aircraft, String profile) {
        this.host = host;
        this.port = port;
        this.aircraft = aircraft;
        this.profile = profile;
    }

    /** Sends the request on the loop and waits for the result; not on the loop's thread. */
    SpawnResult run(final Loop loop) {
        final BlockingQueue<SpawnResult> results = new ArrayBlockingQueue<>(1);
        loop.post(() -> send(loop, results));
        try {
            SpawnResult result = results.poll(MAX_S, TimeUnit.SECONDS);
            return result == null ? SpawnResult.refused("the runner does not answer") : result;
        } catch (InterruptedException interruption) {
            Thread.currentThread().interrupt();
            return SpawnResult.refused("the request was interrupted");
        }
    }

    private void send(Loop loop, final BlockingQueue<SpawnResult> results) {
        final RunnerClient client;
        try {
            String chosen = profile == null || profile.isEmpty() ? null : profile;
            client = new RunnerClient(loop, host, port,
                    new RunnerRequest(aircraft, chosen, null));
        } catch (IllegalArgumentException wrong) {
            results.add(SpawnResult.refused(wrong.getMessage()));
            return;
        }
        client.find(new DiscoveryListener() {
            @Override
            public void onFound(Endpoint place) {
                results.add(result(client.lastAnswer(), place));
            }

            @Override
            public void onNotFound(String reason) {
                results.add(SpawnResult.refused(reason));
            }
        });
    }

    private static SpawnResult result(RunnerAnswer answer, Endpoint place) {
        String sentence = answer.error == null ? answer.message
                : answer.message + ": " + answer.error;
        return SpawnResult.running(answer.isSpawned, sentence, place.toString(),
                answer.proxyHost, answer.proxyGroundPort);
    }
}
