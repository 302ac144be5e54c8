package org.raspilot.app.ground;

import android.content.res.Resources;
import org.raspilot.app.R;
import org.raspilot.app.view.FrameText;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.FlightModes;
import org.raspilot.up.ground.Freshness;
import org.raspilot.up.ground.Telemetry;

/**
 * The line at the top of a screen: mode, motor, age of the newest frame or duration of the silence.
 * It records which frame was drawn, and so seen.
 */
public final class FrameLine implements FrameText.DrawnListener {
    private final FrameText view;
    private final InstrumentColors colors;
    private Long shownBeacon;

    public FrameLine(FrameText view) {
        this.view = view;
        colors = InstrumentColors.of(view.getContext());
        view.setDrawnListener(this);
    }

    /** Releases the view: no frame is visible afterwards. */
    public void close() {
        view.setDrawnListener(null);
        shownBeacon = null;
    }

    /** Returns the beacon of the newest frame that was drawn; null: none. */
    public Long shownBeacon() {
        return shownBeacon;
    }

    /** Resets the seen frames: another link, another aircraft. */
    public void clear() {
        shownBeacon = null;
    }

    @Override
    public void onDrawn(Long beacon) {
        shownBeacon = beacon;
    }

    public void update(GroundSnapshot picture) {
        Telemetry telemetry = picture.telemetry;
        Resources words = view.getResources();
        Long ageMs = telemetry.age.frameMs(picture.nowMs);
        if (ageMs == null) {
            show(words.getString(R.string.frame_none), colors.dim, null);
        } else if (telemetry.age.isSilent(picture.nowMs)) {
            int text = telemetry.age.isLate(picture.nowMs)
                    ? R.string.frame_late : R.string.frame_silent;
            show(words.getString(text, Age.text(ageMs)), colors.alarm, telemetry.beacon);
        } else {
            String text = words.getString(R.string.frame_live, mode(picture, words),
                    armed(picture, words), Age.text(ageMs));
            show(text, colors.ink, telemetry.beacon);
        }
    }

    private void show(String text, int colour, Long beacon) {
        TextViews.colour(view, colour);
        view.setFrame(text, beacon);
    }

    private static String mode(GroundSnapshot picture, Resources words) {
        String mode = FlightModes.actingWithProgress(picture.telemetry);
        return isLive(picture, "flight_mode") ? mode : words.getString(R.string.mode_unknown);
    }

    private static String armed(GroundSnapshot picture, Resources words) {
        Boolean isArmed = picture.telemetry.flag("armed");
        if (isArmed == null || !isLive(picture, "armed")) {
            return words.getString(R.string.armed_unknown);
        }
        return words.getString(isArmed ? R.string.armed_yes : R.string.armed_no);
    }

    private static boolean isLive(GroundSnapshot picture, String path) {
        return picture.telemetry.freshness(path, picture.nowMs) == Freshness.LIVE;
    }
}
