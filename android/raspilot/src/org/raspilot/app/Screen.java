package org.raspilot.app;

import android.app.Fragment;
import org.raspilot.app.commands.CommandsFragment;
import org.raspilot.app.ground.GroundFragment;

/** What a tab shows: its title and its fragment; on a tablet others beside it. */
enum Screen {
    AIRBORNE(R.string.screen_airborne, R.id.pane_first, () -> new AirborneFragment()),
    GROUND(R.string.screen_ground, R.id.pane_first, () -> new GroundFragment()),
    COMMANDS(R.string.screen_commands, R.id.pane_second, () -> new CommandsFragment()),
    SETTINGS(R.string.screen_settings, R.id.pane_first, () -> new SettingsFragment()),
    LOG(R.string.screen_log, R.id.pane_first, () -> new LogFragment());

    interface Maker {
        Fragment make();
    }

    final int title;
    /** The pane that contains the fragment during its whole life. */
    final int pane;
    final Maker maker;

    Screen(int title, int pane, Maker maker) {
        this.title = title;
        this.pane = pane;
        this.maker = maker;
    }

    /** Returns whether a window with or without room for two panes has a tab for this. */
    boolean hasTab(boolean isTwoPanes) {
        return this != COMMANDS || !isTwoPanes;
    }

    /** Returns whether the fragment of a screen is visible while this is chosen. */
    boolean shows(Screen other, boolean isTwoPanes) {
        boolean isBeside = isTwoPanes && this == GROUND && other == COMMANDS;
        return other == this || isBeside;
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
