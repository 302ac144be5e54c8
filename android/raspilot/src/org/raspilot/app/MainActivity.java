package org.raspilot.app;

import android.app.ActionBar;
import android.app.Activity;
import android.app.Fragment;
import android.app.FragmentManager;
import android.app.FragmentTransaction;
import android.os.Bundle;
import android.view.View;

/**
 * The one window: tabs on a phone; on a tablet the ground and the commands screen side by side,
 * both from the same fragments (thesis 3.5.1).
 */
public final class MainActivity extends Activity implements ActionBar.TabListener {
    private static final String CHOSEN = "screen";

    private Screen chosen = Screen.AIRBORNE;
    private boolean isTwoPanes;
    private boolean isReady;

    @Override
    protected void onCreate(Bundle saved) {
        setTheme(AppTheme.style(this));
        super.onCreate(saved);
        setContentView(R.layout.activity_main);
        TelemetryLink.create(this);
        isTwoPanes = getResources().getBoolean(R.bool.two_panes);
        if (saved != null) {
            chosen = Screen.named(saved.getString(CHOSEN));
        }
        chosen = chosen.in(isTwoPanes);
        makeTabs();
        isReady = true;
        show(chosen);
    }

    @Override
    protected void onSaveInstanceState(Bundle state) {
        super.onSaveInstanceState(state);
        state.putString(CHOSEN, chosen.name());
    }

    @Override
    public void onTabSelected(ActionBar.Tab tab, FragmentTransaction unused) {
        if (isReady) {
            show((Screen) tab.getTag());
        }
    }

    @Override
    public void onTabUnselected(ActionBar.Tab tab, FragmentTransaction unused) {
    }

    @Override
    public void onTabReselected(ActionBar.Tab tab, FragmentTransaction unused) {
    }

    /** Receives the user's answer; without @Override, because the API 16 stubs lack the method. */
    public void onRequestPermissionsResult(int request, String[] permissions, int[] answers) {
        Fragment airborne = getFragmentManager().findFragmentByTag(Screen.AIRBORNE.name());
        if (airborne instanceof AirborneFragment) {
            ((AirborneFragment) airborne).permissionsAnswered();
        }
    }

    private void makeTabs() {
        ActionBar bar = getActionBar();
        // On a phone the tabs name the screen; a title would take another tenth of it.
        bar.setDisplayShowHomeEnabled(false);
        bar.setDisplayShowTitleEnabled(isTwoPanes);
        if (!isTwoPanes) {
            // On a phone the tabs need the room of the title.
            bar.setDisplayOptions(0);
        }
        bar.setNavigationMode(ActionBar.NAVIGATION_MODE_TABS);
        for (Screen screen : Screen.values()) {
            if (screen.hasTab(isTwoPanes)) {
                ActionBar.Tab tab = bar.newTab().setText(screen.title).setTag(screen);
                bar.addTab(tab.setTabListener(this), screen == chosen);
            }
        }
    }

    private void show(Screen screen) {
        chosen = screen;
        FragmentManager manager = getFragmentManager();
        FragmentTransaction change = manager.beginTransaction();
        for (Screen part : Screen.values()) {
            Fragment fragment = manager.findFragmentByTag(part.name());
            if (!screen.shows(part, isTwoPanes)) {
                if (fragment != null && !fragment.isDetached()) {
                    change.detach(fragment);
                }
            } else if (fragment == null) {
                change.add(part.pane, part.maker.make(), part.name());
            } else if (fragment.isDetached()) {
                change.attach(fragment);
            }
        }
        change.commit();
        showPane(R.id.pane_first);
        showPane(R.id.pane_second);
    }

    private void showPane(int pane) {
        boolean isUsed = false;
        for (Screen part : Screen.values()) {
            isUsed |= part.pane == pane && chosen.shows(part, isTwoPanes);
        }
        findViewById(pane).setVisibility(isUsed ? View.VISIBLE : View.GONE);
    }
}
