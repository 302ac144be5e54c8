package org.raspilot.app.ground;

import android.app.Activity;
import android.text.InputType;
import android.view.View;
import android.widget.Button;
import android.widget.EditText;
import android.widget.Toast;
import java.io.IOException;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.commands.CatalogueAsset;
import org.raspilot.app.commands.CommandTexts;
import org.raspilot.app.commands.Confirmation;
import org.raspilot.app.view.TextViews;
import org.raspilot.app.view.TrackView;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandCatalogue;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.CommandGate;
import org.raspilot.up.ground.CommandGate.DisabledReason;
import org.raspilot.up.ground.Earth;
import org.raspilot.up.ground.FlightModes;
import org.raspilot.up.ground.Home;
import org.raspilot.up.ground.Telemetry;

/** RETURN and LOITER by a button, GUIDED and home by a tap on the track; each is confirmed. */
final class FlightActions implements TrackView.TapListener {
    private static final String TARGET = "up.navigation.target";
    private static final String HOME = "up.home.set";
    private static final Map<String, Object> NOTHING = Collections.emptyMap();
    private static final double MIN_HEIGHT_M = 30;

    private final Activity activity;
    private final FrameLine frame;
    private final Confirmation confirmation;
    private final Button home;
    private final Button loiter;
    private final CommandForm mode;
    private final CommandForm target;
    private final CommandForm newHome;
    private TelemetryService.Ground ground;

    FlightActions(Activity activity, View root, FrameLine frame) {
        this.activity = activity;
        this.frame = frame;
        confirmation = new Confirmation(activity);
        home = (Button) root.findViewById(R.id.ground_return);
        loiter = (Button) root.findViewById(R.id.ground_loiter);
        home.setOnClickListener(pressed -> ask(FlightModes.RETURN));
        loiter.setOnClickListener(pressed -> ask(FlightModes.LOITER));
        ((TrackView) root.findViewById(R.id.ground_track)).setTapListener(this);
        CommandCatalogue catalogue = catalogue(activity);
        mode = catalogue == null ? null : catalogue.form(Commands.FLIGHT_MODE);
        target = catalogue == null ? null : catalogue.form(TARGET);
        newHome = catalogue == null ? null : catalogue.form(HOME);
    }

    private static CommandCatalogue catalogue(Activity activity) {
        try {
            return CatalogueAsset.read(activity);
        } catch (IOException missing) {
            // The commands screen shows the fault.
            return null;
        }
    }

    /** Sets the ground; null: none, as on a screen that is not visible, which must not be confirmed. */
    void setGround(TelemetryService.Ground newGround) {
        ground = newGround;
        confirmation.dismiss();
    }

    void update(GroundSnapshot picture) {
        Map<String, String> modes = FlightModes.all(picture.telemetry);
        boolean isOffered = objection(mode, picture) == DisabledReason.NONE;
        show(home, FlightModes.RETURN, modes.get(FlightModes.RETURN), isOffered);
        show(loiter, FlightModes.LOITER, modes.get(FlightModes.LOITER), isOffered);
    }

    private void show(Button button, String name, String code, boolean isOffered) {
        TextViews.show(button, CommandTexts.mode(activity.getResources(), name, code));
        button.setEnabled(isOffered && code == null);
    }

    private void ask(String name) {
        String now = FlightModes.acting(GroundSnapshot.of(ground).telemetry);
        confirmation.show(activity.getString(R.string.fly_question, name),
                activity.getString(R.string.fly_now, now), name, null, () -> select(name));
    }

    @Override
    public void onTap(double northM, double eastM) {
        GroundSnapshot picture = GroundSnapshot.of(ground);
        if (picture.track == null || picture.track.origin == null) {
            return;
        }
        DisabledReason reason = objection(target, picture);
        if (reason != DisabledReason.NONE) {
            say(CommandTexts.objection(activity.getResources(), reason, picture));
            return;
        }
        final Home origin = picture.track.origin;
        Telemetry telemetry = picture.telemetry;
        final boolean isAboveHome = telemetry.number("home.altitude") != null;
        Double known = telemetry.number(isAboveHome ? "navigation.height" : "navigation.altitude");
        final EditText height = new EditText(activity);
        height.setId(R.id.ground_height);
        height.setInputType(InputType.TYPE_CLASS_NUMBER | InputType.TYPE_NUMBER_FLAG_DECIMAL);
        if (known != null) {
            double offeredM = isAboveHome ? Math.max(MIN_HEIGHT_M, known) : known;
            height.setText(Long.toString(Math.round(offeredM)));
        }
        String text = activity.getString(
                isAboveHome ? R.string.fly_height : R.string.fly_altitude,
                Math.round(Math.hypot(northM, eastM)));
        final Map<String, String> fields = new LinkedHashMap<>();
        fields.put("latitude", Double.toString(Earth.latitudeDeg(origin, northM)));
        fields.put("longitude", Double.toString(Earth.longitudeDeg(origin, eastM)));
        confirmation.show(activity.getString(R.string.fly_here), text,
                activity.getString(R.string.fly_yes), height, () -> {
                fields.put(isAboveHome ? "height" : "altitude", height.getText().toString());
                String selected = GroundSnapshot.of(ground).telemetry
                        .text("flight_control.selected");
                boolean isGuided = FlightModes.GUIDED.equals(selected);
                send(target, fields, isGuided ? null : () -> select(FlightModes.GUIDED));
            }, activity.getString(R.string.home_yes), () -> askHome(fields, isAboveHome));
    }

    private void askHome(Map<String, String> place, boolean isKept) {
        confirmation.show(activity.getString(R.string.home_question),
                activity.getString(isKept ? R.string.home_kept : R.string.home_new),
                activity.getString(R.string.home_yes), null, () -> send(newHome, place, null));
    }

    private void send(CommandForm form, Map<String, String> fields, Runnable then) {
        try {
            send(form.command(fields), then);
        } catch (InvalidCommandException wrong) {
            say(wrong.getMessage());
        }
    }

    private void select(String name) {
        send(Commands.flightMode(name), null);
    }

    /** Sends a Command; {@code then} runs when the aircraft carried it out. */
    private void send(BaseCommand command, Runnable then) {
        if (ground == null) {
            return;
        }
        ground.send(command, frame.shownBeacon(), answer -> {
            if (!answer.isAck()) {
                say(answer.why());
            } else if (then != null) {
                then.run();
            }
        });
    }

    private static DisabledReason objection(CommandForm form, GroundSnapshot picture) {
        return form == null ? DisabledReason.NO_LINK : CommandGate.objection(form, NOTHING,
                picture.status, picture.telemetry, picture.nowMs);
    }

    private void say(String text) {
        Toast.makeText(activity, text, Toast.LENGTH_LONG).show();
    }
}
