package org.raspilot.up.airborne;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.raspilot.up.net.SettingRules;
import org.raspilot.up.providers.AltitudeProvider;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.OrientationProvider;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.tls.TlsIdentity;

/**
 * Settings of the airborne side, created by its {@link Builder}, which validates them.
 *
 * <p>Ports and addresses are by default those of the Raspberry Pi's {@code android.yml}, {@code
 * discovery.yml} and {@code runner.yml}.
 */
public final class AirborneSettings {
    private static final int MAX_PERIOD_MS = 10000;
    public final AirborneMode mode;
    /** The Raspberry Pi's host; empty: Discovery, in Black Box Mode the runner. */
    public final String host;
    public final int generalPort;
    public final int orientationPort;
    public final int discoveryPort;
    /** Discovery's targets; empty: 255.255.255.255 and every interface's own. */
    public final List<String> discoveryHosts;
    /** The runner's host, Black Box Mode only; empty: the host runs already. */
    public final String runnerHost;
    public final int runnerPort;
    /** The aircraft's name for the runner; empty: none. */
    public final String aircraft;
    /** The runner's ready-made configuration; empty: none. */
    public final String profile;
    /** This device's key of the aircraft, for the runner; null: its request is plain. */
    public final Pairing pairing;
    /** The certificates of TLS to the runner; null: plain TCP. */
    public final TlsIdentity runnerTls;
    public final OrientationTransport orientation;
    private final boolean redundantOrientation;
    /** How often orientation leaves, Hz, 50 to 200. */
    public final int orientationHz;
    /** How often the location leaves at most, ms. */
    public final int locationPeriodMs;
    /** How often the altitude leaves at most, ms. */
    public final int altitudePeriodMs;
    /** How often the heading leaves at most, ms. */
    public final int headingPeriodMs;
    /** The pressure at altitude zero, hPa. */
    public final double referencePressureHPa;
    public final Mounting mounting;

    private AirborneSettings(Builder builder) {
        mode = builder.mode;
        host = builder.host;
        generalPort = builder.generalPort;
        orientationPort = builder.orientationPort;
        discoveryPort = builder.discoveryPort;
        discoveryHosts = Collections.unmodifiableList(new ArrayList<>(builder.discoveryHosts));
        runnerHost = builder.runnerHost;
        runnerPort = builder.runnerPort;
        aircraft = builder.aircraft;
        profile = builder.profile;
        pairing = builder.pairing;
        runnerTls = builder.runnerTls;
        orientation = builder.orientation;
        redundantOrientation = builder.redundantOrientation;
        orientationHz = builder.orientationHz;
        locationPeriodMs = builder.locationPeriodMs;
        altitudePeriodMs = builder.altitudePeriodMs;
        headingPeriodMs = builder.headingPeriodMs;
        referencePressureHPa = builder.referencePressureHPa;
        mounting = builder.mounting;
    }

    /** Returns whether a runner starts the server: in Black Box Mode, if one is configured. */
    public boolean isByRunner() {
        return mode == AirborneMode.BLACK_BOX && !runnerHost.isEmpty();
    }

    /** Returns how the request to the runner is protected, without a full stop. */
    public String runnerSecurityText() {
        final String hop = runnerTls == null ? "plain" : "TLS";
        return pairing == null ? hop : hop + ", signed by " + pairing;
    }

    /**
     * Returns the transport of orientation in this mode. In Flight Controller Mode the Arduino's
     * orientation is used, and the phone's is off unless redundancy is wanted (thesis 4.2.3).
     */
    public OrientationTransport orientationTransport() {
        boolean isWanted = mode == AirborneMode.BLACK_BOX || redundantOrientation;
        return isWanted ? orientation : OrientationTransport.OFF;
    }

    private void check() {
        hostOrNothing("host", host);
        hostOrNothing("runner's host", runnerHost);
        for (String each : discoveryHosts) {
            SettingRules.host("address of Discovery", each);
        }
        SettingRules.port("port of the Raspberry Pi", generalPort);
        SettingRules.port("port for orientation", orientationPort);
        SettingRules.port("port of Discovery", discoveryPort);
        SettingRules.port("runner's port", runnerPort);
        if (!aircraft.isEmpty()) {
            SettingRules.aircraft(aircraft);
        }
        SettingRules.range("length of the profile's name", profile.length(), 0, 64);
        SettingRules.pairing(pairing, aircraft);
        SettingRules.range("rate of orientation (Hz)", orientationHz,
                OrientationProvider.MIN_HZ, OrientationProvider.MAX_HZ);
        SettingRules.range("period of the location (ms)", locationPeriodMs, 20, MAX_PERIOD_MS);
        SettingRules.range("period of the altitude (ms)", altitudePeriodMs, 20, MAX_PERIOD_MS);
        SettingRules.range("period of the heading (ms)", headingPeriodMs, 20, MAX_PERIOD_MS);
        SettingRules.range("reference pressure (hPa)", referencePressureHPa,
                AltitudeProvider.MIN_REFERENCE_HPA, AltitudeProvider.MAX_REFERENCE_HPA);
        if (mode == AirborneMode.BLACK_BOX && runnerHost.isEmpty()) {
            SettingRules.host("host of the runner, or of a running server", host);
        }
    }

    private static void hostOrNothing(String setting, String host) {
        if (!host.isEmpty()) {
            SettingRules.host(setting, host);
        }
    }

    /** Builds settings; a value that is not set keeps its default. Names and units as above. */
    public static final class Builder {
        private AirborneMode mode = AirborneMode.FLIGHT_CONTROLLER;
        private String host = "";
        private int generalPort = 50001;
        private int orientationPort = 50000;
        private int discoveryPort = 3001;
        private List<String> discoveryHosts = new ArrayList<>();
        private String runnerHost = "";
        private int runnerPort = 3002;
        private String aircraft = "";
        private String profile = "";
        private Pairing pairing;
        private TlsIdentity runnerTls;
        private OrientationTransport orientation = OrientationTransport.TCP;
        private boolean redundantOrientation;
        private int orientationHz = 50;
        private int locationPeriodMs = 500;
        private int altitudePeriodMs = 200;
        private int headingPeriodMs = 200;
        private double referencePressureHPa = 1013.25;
        private Mounting mounting = Mounting.FLAT;

        public Builder mode(AirborneMode v) { mode = v; return this; }
        public Builder host(String v) { host = v; return this; }
        public Builder generalPort(int v) { generalPort = v; return this; }
        public Builder orientationPort(int v) { orientationPort = v; return this; }
        public Builder discoveryPort(int v) { discoveryPort = v; return this; }
        public Builder discoveryHosts(List<String> v) { discoveryHosts = v; return this; }
        public Builder runnerHost(String v) { runnerHost = v; return this; }
        public Builder runnerPort(int v) { runnerPort = v; return this; }
        public Builder aircraft(String v) { aircraft = v; return this; }
        public Builder profile(String v) { profile = v; return this; }
        public Builder pairing(Pairing v) { pairing = v; return this; }
        public Builder runnerTls(TlsIdentity v) { runnerTls = v; return this; }
        public Builder orientation(OrientationTransport v) { orientation = v; return this; }
        public Builder redundantOrientation(boolean v) { redundantOrientation = v; return this; }
        public Builder orientationHz(int v) { orientationHz = v; return this; }
        public Builder locationPeriodMs(int v) { locationPeriodMs = v; return this; }
        public Builder altitudePeriodMs(int v) { altitudePeriodMs = v; return this; }
        public Builder headingPeriodMs(int v) { headingPeriodMs = v; return this; }
        public Builder referencePressureHPa(double v) { referencePressureHPa = v; return this; }
        public Builder mounting(Mounting v) { mounting = v; return this; }

        /** Returns the settings; raises IllegalArgumentException with a sentence for the user. */
        public AirborneSettings build() {
            AirborneSettings settings = new AirborneSettings(this);
            settings.check();
            return settings;
        }
    }

    /** Who the phone speaks to (thesis 3.1.3). */
    public enum AirborneMode {
        /** A Raspberry Pi on board, with an Arduino that flies. */
        FLIGHT_CONTROLLER,
        /** A server on the internet that a runner spawns; the phone is the only one on board. */
        BLACK_BOX
    }

    /** How orientation leaves the phone. */
    public enum OrientationTransport {
        OFF,
        /** Frames back to back on a connection. */
        TCP,
        /** A frame a datagram. */
        UDP
    }
}
