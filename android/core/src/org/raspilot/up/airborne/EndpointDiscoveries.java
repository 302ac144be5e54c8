package org.raspilot.up.airborne;

import org.raspilot.up.loop.Loop;
import org.raspilot.up.net.DiscoveryClient.BroadcastAddresses;
import org.raspilot.up.net.DiscoveryClient;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.net.EndpointDiscovery;
import org.raspilot.up.net.FixedEndpoint;
import org.raspilot.up.net.InterfaceBroadcasts;
import org.raspilot.up.net.RunnerClient;
import org.raspilot.up.net.RunnerRequest;

/** Chooses how the Raspberry Pi, or the server in its place, is found. */
final class EndpointDiscoveries {
    /** The name that nameless clients of a runner share (protocols 8). */
    private static final String NAMELESS = "default";

    private EndpointDiscoveries() {}

    /** Returns the runner in Black Box Mode, otherwise the configured host, otherwise Discovery. */
    static EndpointDiscovery by(Loop loop, final AirborneSettings settings) {
        if (settings.isByRunner()) {
            RunnerRequest request = new RunnerRequest(
                    settings.aircraft.isEmpty() ? NAMELESS : settings.aircraft,
                    settings.profile.isEmpty() ? null : settings.profile,
                    null);
            return new RunnerClient(loop, settings.runnerHost, settings.runnerPort, request);
        }
        if (!settings.host.isEmpty()) {
            return new FixedEndpoint(new Endpoint(
                    settings.host, settings.generalPort, settings.orientationPort));
        }
        return new DiscoveryClient(loop, asked(settings), settings.discoveryPort,
                settings.generalPort, settings.orientationPort);
    }

    private static BroadcastAddresses asked(final AirborneSettings settings) {
        if (settings.discoveryHosts.isEmpty()) {
            return new InterfaceBroadcasts();
        }
        return () -> settings.discoveryHosts;
    }
}
