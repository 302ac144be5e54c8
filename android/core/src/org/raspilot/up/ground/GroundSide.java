package org.raspilot.up.ground;

import java.util.Random;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.ground.GroundLink.LinkListener;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.wire.GeneralMessage;

/**
 * The ground's end of the link: telemetry in, Commands out, the seat, and what a screen shows.
 *
 * <p>Only on the loop; what it hands out is immutable and may go to any thread. Source: thesis
 * 4.5.2, docs/protocols.md 4, 6 and 9.
 */
public final class GroundSide implements TelemetrySource {
    /** Period of the checks for changes due to time alone, ms. */
    private static final long TICK_MS = 250;
    /** Period of the status for its figures, ms; a change is reported immediately. */
    private static final long STATUS_MS = 1000;

    private final Loop loop;
    private final GroundSettings settings;
    private final CommandExecutor executor;
    private final GroundListener listener;
    private final GroundLink link;
    private final TelemetryStream stream = new TelemetryStream();
    private final ShownBeacons beacons = new ShownBeacons();
    private final PendingCommands answers;
    private final CommandService desk;
    private final GainsService gains;
    private final HomeEstimator home = new HomeEstimator();
    private final Track track = new Track();
    private final EventLog events = new EventLog();
    private final Alarms alarms = new Alarms();
    private final EventMonitor judge = new EventMonitor(events, alarms);
    private Cancellable tick;
    private Cancellable silence = Cancellable.DONE;
    private boolean wasSilent = true;
    private boolean wasLate;
    private long reportedMs;
    private long reportedVersions;

    /**
     * Creates a ground that is not started.
     *
     * @param tokens stores the resume token
     * @param executor runs the handlers of the aircraft's Commands, telemetry included
     * @param random makes ids and varies the waits
     */
    public GroundSide(Loop loop, GroundSettings settings, TokenStore tokens,
            CommandExecutor executor, GroundListener listener, Random random) {
        this.loop = loop;
        this.settings = settings;
        this.executor = executor;
        this.listener = listener;
        link = new GroundLink(loop, settings, tokens, new Links(), random);
        answers = new PendingCommands(loop, random);
        desk = new CommandService(loop, link, settings, answers, beacons);
        gains = new GainsService(loop, (command, shownBeacon, answered) ->
                transmit(command, shownBeacon, answered));
    }

    /** Starts to connect, and reconnects after each loss; no effect when started already. */
    public void start() {
        if (tick == null) {
            judge.reset();
            stream.reset();
            tick();
            link.start();
        }
    }

    /** Closes the link; waiting Commands end with a lost link. */
    public void stop() {
        if (tick != null) {
            tick.cancel();
            tick = null;
            silence.cancel();
            link.stop();
            judge.reset();
            reportChanges();
        }
    }

    /** Retries immediately, for example when the phone's network is back. */
    public void reconnectNow() {
        link.reconnectNow();
    }

    public GroundStatus status() {
        return new GroundStatus(link.facts(), settings.isDirect, stream, loop.nowMs());
    }

    @Override
    public Telemetry telemetry() {
        return stream.newest();
    }

    public Track track() {
        return track;
    }

    public EventLog events() {
        return events;
    }

    public Alarms alarms() {
        return alarms;
    }

    public GainsService gains() {
        return gains;
    }

    /**
     * Sends a Command once, without automatic repetition, or refuses it with a sentence.
     *
     * @param shownBeacon the beacon of the frame that the screen shows, or null
     * @param answered receives the outcome, once
     */
    public void send(BaseCommand command, Long shownBeacon, AnswerListener answered) {
        final GainSet set;
        try {
            set = GainsService.gainsOf(command);
        } catch (InvalidCommandException fault) {
            answered.onAnswer(Answer.refused(command.name(), "invalid", fault.getMessage()));
            return;
        }
        if (set == null) {
            transmit(command, shownBeacon, answered);
        } else {
            gains.set(set, shownBeacon, answered);
        }
        reportChanges();
    }

    /** Requests the seat; a free one is granted immediately. Returns false without a link. */
    public boolean requestControl() {
        return link.requestControl();
    }

    /** Hands the seat to the listener with that number. False: it is not ours. */
    public boolean giveControl(int to) {
        return link.giveControl(to);
    }

    /** Leaves the seat free. False: it is not ours. */
    public boolean releaseControl() {
        return link.releaseControl();
    }

    private void transmit(final BaseCommand command, Long shownBeacon,
            final AnswerListener answered) {
        final GainSet set = command.data().containsKey("pids")
                ? GainsService.gainsOf(command) : null;
        final String words = set == null ? CommandTexts.of(command) : CommandTexts.ofGains(
                GainsService.difference(gains.snapshot().flying, set));
        final boolean isQuiet = PendingCommands.isRequest(command);
        desk.send(command, shownBeacon, answer -> {
            if (answer.outcome != Answer.Outcome.REFUSED && !(isQuiet && answer.isAck())) {
                events.add(loop.nowMs(),
                        answer.isAck() ? EventLevel.INFO : EventLevel.WARNING,
                        (set == null ? "command_" : "gains_")
                                + answer.outcome.code(),
                        CommandTexts.outcome(words, answer));
            }
            answered.onAnswer(answer);
            reportChanges();
        });
    }

    private void onFrame(GeneralMessage message) {
        final long nowMs = loop.nowMs();
        final Telemetry frame = stream.receive(message, nowMs);
        beacons.onFrame(frame);
        home.update(frame);
        track.update(frame, home.home(), nowMs);
        awaitSilence(frame, nowMs);
        judge.update(frame, status(), nowMs);
        executor.executeCommand(new BaseCommand(message));
        listener.onTelemetry(frame);
        if (wasSilent != frame.age.isSilent(nowMs) || wasLate != frame.age.isLate(nowMs)) {
            reportStatus();
        }
        final ControlStatus control = ControlStatus.of(link.facts(), settings.isDirect);
        if (control == ControlStatus.OURS && !frame.age.isSilent(nowMs)
                && link.facts().keyFault().isEmpty()) {
            gains.onTick();
        }
        reportChanges();
    }

    /** Checks again when this frame expires, so that silence is reported without another event. */
    private void awaitSilence(Telemetry frame, long nowMs) {
        silence.cancel();
        final Long ageMs = frame.age.frameMs(nowMs);
        if (ageMs != null && ageMs <= TelemetrySchema.SILENT_MS) {
            silence = loop.schedule(TelemetrySchema.SILENT_MS + 1 - ageMs, () -> check(true));
        }
    }

    private void tick() {
        tick = loop.schedule(TICK_MS, () -> {
            tick();
            check(loop.nowMs() - reportedMs >= STATUS_MS);
        });
    }

    /** Updates the alarms and events and reports the changes. */
    private void check(boolean isStatusDue) {
        judge.update(stream.newest(), status(), loop.nowMs());
        if (isStatusDue) {
            reportStatus();
        }
        reportChanges();
    }

    private void reportStatus() {
        reportedMs = loop.nowMs();
        final GroundStatus status = status();
        wasSilent = status.isSilent;
        wasLate = status.isLate;
        listener.onStatus(status);
    }

    private void reportChanges() {
        // Each version only increases.
        final long versions = track.version() + events.version() + alarms.snapshot().version
                + gains.version();
        if (versions != reportedVersions) {
            reportedVersions = versions;
            listener.onChanged();
        }
    }

    private final class Links implements LinkListener {
        @Override
        public void onMessage(GeneralMessage message) {
            if (message.name.equals(Telemetry.NAME)) {
                onFrame(message);
                return;
            }
            if (message.name.equals(GainsService.VALUES) && !gains.receive(message.data)) {
                judge.add("gains_invalid", "", loop.nowMs());
            }
            answers.receive(message);
            executor.executeCommand(new BaseCommand(message));
            reportChanges();
        }

        @Override
        public void onClock(double clockMs, long fromMs, long toMs) {
            stream.onClock(clockMs, fromMs, toMs);
        }

        @Override
        public void onOpened() {
            stream.onRoundTrip(link.facts().roundTripMs);
            gains.requestAgain();
        }

        @Override
        public void onLost(String reason) {
            beacons.onLost();
            silence.cancel();
            if (stream.newest() != Telemetry.EMPTY) {
                listener.onTelemetry(stream.onLost());
            }
            answers.onLost();
        }

        @Override
        public void onLink() {
            judge.onLink(status(), loop.nowMs());
            check(true);
        }
    }
}
