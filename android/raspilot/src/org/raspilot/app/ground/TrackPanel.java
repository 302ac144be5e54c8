package org.raspilot.app.ground;

import android.app.Activity;
import android.content.ActivityNotFoundException;
import android.content.Intent;
import android.net.Uri;
import android.view.View;
import android.widget.TextView;
import android.widget.Toast;
import java.util.List;
import java.util.Locale;
import org.raspilot.app.R;
import org.raspilot.app.view.TextViews;
import org.raspilot.app.view.TrackView;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Earth;
import org.raspilot.up.ground.Freshness;
import org.raspilot.up.ground.Home;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.Track.TrackPoint;
import org.raspilot.up.ground.Track;

/** The track, the aircraft's position, and a link to the system's own map. */
final class TrackPanel {
    private final Activity activity;
    private final TrackView view;
    private final TextView place;
    private final View map;
    private Track.Snapshot shown;
    private Double latitudeDeg;
    private Double longitudeDeg;

    TrackPanel(Activity activity, View root) {
        this.activity = activity;
        view = (TrackView) root.findViewById(R.id.ground_track);
        place = (TextView) root.findViewById(R.id.ground_place);
        map = root.findViewById(R.id.ground_map);
        map.setOnClickListener(pressed -> openMap());
        root.findViewById(R.id.ground_follow).setOnClickListener(pressed -> view.follow());
        root.findViewById(R.id.ground_larger).setOnClickListener(pressed -> view.enlarge());
        root.findViewById(R.id.ground_smaller).setOnClickListener(pressed -> view.shrink());
    }

    void update(GroundSnapshot picture) {
        Track.Snapshot track = picture.track;
        // Most frames add no point: the track is long, and copied only when it grew.
        if (isNew(track)) {
            showTrack(track);
        }
        shown = track;
        Telemetry telemetry = picture.telemetry;
        TrackPoint newest = track == null ? null : track.newest;
        boolean hasTrack = newest != null;
        boolean isThere = telemetry.number("location.latitude") != null;
        boolean isHeadingLive = telemetry.freshness("heading.actual", picture.nowMs)
                == Freshness.LIVE;
        view.setAircraft(newest == null ? null : newest.northM,
                newest == null ? null : newest.eastM,
                isHeadingLive ? telemetry.number("heading.actual") : null);
        showTarget(track, telemetry);
        Freshness freshness = telemetry.freshness("location.latitude", picture.nowMs);
        if (!hasTrack) {
            freshness = Freshness.NONE;
        } else if (!isThere) {
            // The flown track stays known when positions stop.
            freshness = Freshness.STALE;
        }
        String age = InstrumentPanel.ageText(picture, "location.latitude");
        view.setFreshness(freshness, age);
        showPlace(picture, age);
    }

    private boolean isNew(Track.Snapshot track) {
        return track == null || shown == null ? track != shown
                : track.points != shown.points
                || track.isOriginHome != shown.isOriginHome;
    }

    private void showTrack(Track.Snapshot track) {
        List<TrackPoint> points = track == null
                ? java.util.Collections.emptyList() : track.points;
        float[] north = new float[points.size()];
        float[] east = new float[north.length];
        boolean[] hasGapBefore = new boolean[north.length];
        for (int each = 0; each < north.length; each++) {
            TrackPoint point = points.get(each);
            north[each] = (float) point.northM;
            east[each] = (float) point.eastM;
            hasGapBefore[each] = point.isAfterSilence;
        }
        view.setTrack(north, east, hasGapBefore, track != null && track.isOriginHome);
    }

    private void showTarget(Track.Snapshot track, Telemetry telemetry) {
        Double latitude = telemetry.number("navigation.target.latitude");
        Double longitude = telemetry.number("navigation.target.longitude");
        if (track == null || track.origin == null || latitude == null || longitude == null) {
            view.setTarget(null, null, null);
            return;
        }
        Home origin = track.origin;
        view.setTarget(Earth.northM(origin.latitudeDeg, latitude),
                Earth.eastM(origin.longitudeDeg, longitude, origin.latitudeDeg),
                telemetry.number("navigation.target.radius"));
    }

    private void showPlace(GroundSnapshot picture, String age) {
        Telemetry telemetry = picture.telemetry;
        Double latitude = telemetry.number("location.latitude");
        Double longitude = telemetry.number("location.longitude");
        if (latitude != null && longitude != null) {
            latitudeDeg = latitude;
            longitudeDeg = longitude;
        }
        map.setEnabled(latitudeDeg != null);
        if (latitudeDeg == null) {
            TextViews.show(place, activity.getString(R.string.ground_place_unknown));
            return;
        }
        boolean isLive = telemetry.freshness("location.latitude", picture.nowMs)
                == Freshness.LIVE;
        int text = isLive ? R.string.ground_place : R.string.ground_place_old;
        TextViews.show(place, activity.getString(text, latitudeDeg, longitudeDeg, age));
    }

    private void openMap() {
        if (latitudeDeg == null) {
            return;
        }
        String label = Uri.encode(activity.getString(R.string.ground_map_label));
        // Not the user's language: a decimal comma would be another place.
        String at = String.format(Locale.ROOT, "%.7f,%.7f", latitudeDeg, longitudeDeg);
        Uri uri = Uri.parse("geo:" + at + "?q=" + at + "(" + label + ")");
        try {
            activity.startActivity(new Intent(Intent.ACTION_VIEW, uri));
        } catch (ActivityNotFoundException none) {
            Toast.makeText(activity, R.string.ground_no_map, Toast.LENGTH_LONG).show();
        }
    }
}
