package org.raspilot.app.commands;

import android.content.Context;
import android.content.res.Resources;
import android.text.TextUtils;
import android.view.View;
import android.widget.TextView;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.app.view.HoldButton;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.ground.CommandGate.DisabledReason;
import org.raspilot.up.ground.Freshness;

/** Arm and disarm, each by a press that is held: nothing happens by a slip of the hand. */
final class ArmPage extends Page implements HoldButton.HoldListener {
    private static final Map<String, Object> NOTHING = Collections.emptyMap();

    private final CommandForm arm;
    private final CommandForm disarm;
    private final HoldButton armButton;
    private final HoldButton disarmButton;
    private final TextView state;
    private final TextView vetoes;
    private final TextView armWhy;
    private final TextView disarmWhy;
    private final TextView note;

    /** Creates the page; a form that the catalogue lacks is null. */
    ArmPage(CommandForm arm, CommandForm disarm, CommandsScreen desk) {
        super(desk, R.layout.page_arm);
        this.arm = arm;
        this.disarm = disarm;
        armButton = (HoldButton) element.findViewById(R.id.arm_button);
        disarmButton = (HoldButton) element.findViewById(R.id.disarm_button);
        state = text(R.id.arm_state);
        vetoes = text(R.id.arm_vetoes);
        armWhy = text(R.id.arm_why);
        disarmWhy = text(R.id.disarm_why);
        note = text(R.id.arm_note);
        armButton.setHoldListener(this);
        disarmButton.setHoldListener(this);
        update();
    }

    @Override
    void update() {
        Resources words = desk.context().getResources();
        GroundSnapshot picture = desk.picture();
        boolean isLive = picture.telemetry.freshness("armed", picture.nowMs) == Freshness.LIVE;
        Boolean isArmed = isLive ? picture.telemetry.flag("armed") : null;
        TextViews.show(state, words.getString(isArmed == null ? R.string.arm_state_unknown
                : isArmed ? R.string.arm_state_armed : R.string.arm_state_disarmed));
        TextViews.show(vetoes, vetoes(words, picture, isArmed));
        offer(armButton, armWhy, arm);
        offer(disarmButton, disarmWhy, disarm);
    }

    @Override
    public void onHeld(View button) {
        TextViews.show(note, "");
        carryOut(formOf(button));
    }

    @Override
    public void onClickedOnly(View button) {
        final CommandForm form = formOf(button);
        if (form == null || desk.objection(form, NOTHING) != DisabledReason.NONE) {
            return;
        }
        Context context = desk.context();
        String title = CommandTexts.title(form.name);
        desk.confirm(context.getString(R.string.arm_question, title), form.text, title,
                () -> carryOut(form));
    }

    @Override
    public void onTooShort(View button) {
        TextViews.show(note, desk.context().getString(R.string.arm_too_short));
    }

    private void carryOut(CommandForm form) {
        // Between the press and now the seat or the link may be gone.
        if (form != null && desk.objection(form, NOTHING) == DisabledReason.NONE) {
            desk.send(new BaseCommand(form.name, NOTHING),
                    CommandTexts.title(form.name));
        }
    }

    private void offer(HoldButton button, TextView why, CommandForm form) {
        String objection = form == null ? desk.context().getString(R.string.why_unknown)
                : desk.objectionText(form, NOTHING);
        TextViews.show(why, objection);
        if (button.isEnabled() != objection.isEmpty()) {
            button.setEnabled(objection.isEmpty());
        }
    }

    private CommandForm formOf(View button) {
        return button == armButton ? arm : disarm;
    }

    private static String vetoes(Resources words, GroundSnapshot picture, Boolean isArmed) {
        List<String> all = picture.telemetry.texts("vetoes");
        if (Boolean.TRUE.equals(isArmed)) {
            return words.getString(R.string.arm_disarms_when);
        }
        if (isArmed == null || all == null || all.isEmpty()) {
            return "";
        }
        return words.getString(R.string.arm_will_refuse, TextUtils.join("; ", all));
    }
}
