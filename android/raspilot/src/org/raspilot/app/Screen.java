package org.raspilot.app;

import android.app.Fragment;
import org.raspilot.app.commands.CommandsFragment;
import org.raspilot.app.ground.GroundFragment;

/** What a tab shows: its title and the fragments in the two panes. */
enum Screen {
    AIRBORNE(R.string.screen_airborne, Part.AIRBORNE),
    GROUND(R.string.screen_ground, Part.GROUND),
    COMMANDS(R.string.screen_commands, Part.COMMANDS),
    SETTINGS(R.string.screen_settings, Part.SETTINGS),
    LOG(R.string.screen_log, Part.LOG);

    /** A fragment and the pane that contains it during its whole life. */
    enum Part {
        AIRBORNE(R.id.pane_first, () -> new AirborneFragment()),
        GROUND(R.id.pane_first, () -> new GroundFragment()),
        COMMANDS(R.id.pane_second, () -> new CommandsFragment()),
        SETTINGS(R.id.pane_first, () -> new SettingsFragment()),
        LOG(R.id.pane_first, () -> new LogFragment());

        /** Creates the fragment. */
        interface Maker {
            Fragment make();
        }

        final int pane;
        final Maker maker;

        Part(int pane, Maker maker) {
            this.pane = pane;
            this.maker = maker;
        }
    }

    final int title;
    private final Part part;

    Screen(int title, Part part) {
        this.title = title;
        this.part = part;
    }

    /** Returns whether a window with or without room for two panes has a tab for this. */
    boolean hasTab(boolean isTwoPanes) {
        return this != COMMANDS || !isTwoPanes;
    }

    /** Returns whether a part is visible while this is chosen. */
    boolean shows(Part other, boolean isTwoPanes) {
        boolean isBeside = isTwoPanes && this == GROUND && other == Part.COMMANDS;
        return other == part || isBeside;
    }

    /** Returns the screen that replaces this one in such a window. */
    Screen in(boolean isTwoPanes) {
        return hasTab(isTwoPanes) ? this : GROUND;
    }

    /** Returns the screen of that name, or the airborne one if unknown. */
    static Screen named(String name) {
        for (Screen screen : values()) {
            if (screen.name().equals(name)) {
                return screen;
            }
        }
        return AIRBORNE;
    }
}
