package org.raspilot.app;

import android.app.Fragment;
import android.os.Bundle;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.android.BaseUpService.UpWatcher;
import org.raspilot.up.android.BaseUpService;

/** The airborne screen: sent readings, rates, destination, and the phone's mounting. */
public final class AirborneFragment extends Fragment
        implements UpWatcher, AppLog.Watcher {
    private static final String IS_STARTING = "starting";
    private static final String WAS_ASKED = "asked";

    private RaspilotApplication application;
    private AirborneLink link;
    private RunPanel run;
    private ProvidersPanel providers;
    private MountingPanel mounting;
    private PhonePanel phone;
    private AirborneStatus status;
    private boolean isStarting;
    private boolean wasAsked;

    @Override
    public void onCreate(Bundle saved) {
        super.onCreate(saved);
        application = RaspilotApplication.of(getActivity());
        isStarting = saved != null && saved.getBoolean(IS_STARTING);
        wasAsked = saved != null && saved.getBoolean(WAS_ASKED);
        link = new AirborneLink(getActivity(), this);
    }

    @Override
    public View onCreateView(LayoutInflater inflater, ViewGroup container, Bundle saved) {
        View root = inflater.inflate(R.layout.fragment_airborne, container, false);
        AppSettings settings = new AppSettings(getActivity());
        run = new RunPanel(root, pressed -> press());
        providers = new ProvidersPanel(root, pressed -> zeroAltitude());
        phone = new PhonePanel(getActivity(), root, settings);
        mounting = new MountingPanel(root, settings, sentence -> application.log(sentence));
        return root;
    }

    @Override
    public void onStart() {
        super.onStart();
        application.events().addWatcher(this);
        application.spawning().setWatcher(() -> showRun());
        mounting.begin();
        link.begin();
        showAll();
    }

    @Override
    public void onResume() {
        super.onResume();
        phone.show();
    }

    @Override
    public void onStop() {
        link.end();
        mounting.end();
        application.spawning().setWatcher(null);
        application.events().removeWatcher(this);
        status = null;
        super.onStop();
    }

    @Override
    public void onDestroyView() {
        run = null;
        providers = null;
        mounting = null;
        phone = null;
        super.onDestroyView();
    }

    @Override
    public void onSaveInstanceState(Bundle state) {
        super.onSaveInstanceState(state);
        state.putBoolean(IS_STARTING, isStarting);
        state.putBoolean(WAS_ASKED, wasAsked);
    }

    @Override
    public void onStatus(AirborneStatus newest) {
        status = newest;
        showRun();
    }

    @Override
    public void onEvents() {
        showRun();
    }

    /** Continues after the user's answer; a refused permission makes its sensor absent. */
    void permissionsAnswered() {
        if (getActivity() == null) {
            return;
        }
        if (phone != null) {
            phone.onAnswered();
        }
        if (link.isRunning()) {
            link.airside().permissionsChanged();
        }
        if (isStarting) {
            isStarting = false;
            start();
        }
    }

    private void press() {
        if (application.spawning().isAsking()) {
            application.spawning().cancel();
        } else if (link.isRunning()) {
            stop();
        } else if (!wasAsked && phone.requestPermissions()) {
            wasAsked = true;
            isStarting = true;
        } else {
            start();
        }
    }

    private void stop() {
        if (getFragmentManager().findFragmentByTag(StopDialog.TAG) == null) {
            new StopDialog().show(getFragmentManager(), StopDialog.TAG);
        }
    }

    private void start() {
        try {
            AirborneSettings settings = new AppSettings(getActivity()).airborne();
            if (settings.isByRunner()) {
                application.spawning().request(settings);
            } else {
                BaseUpService.start(getActivity(), RaspilotUpService.class);
            }
        } catch (IllegalArgumentException wrong) {
            application.log(wrong.getMessage());
        }
    }

    private void zeroAltitude() {
        if (link.isRunning()) {
            link.airside().zeroAltitudeHere();
        }
    }

    private void showAll() {
        try {
            run.showSettings(new AppSettings(getActivity()).airborne());
        } catch (IllegalArgumentException wrong) {
            run.showFault(wrong.getMessage());
        }
        phone.show();
        showRun();
    }

    private void showRun() {
        if (run == null) {
            return;
        }
        providers.show(status);
        if (link.isRunning()) {
            run.showRunning(status);
        } else {
            AppLog.Entry newest = application.events().newest();
            run.showStopped(application.spawning().isAsking(),
                    newest == null ? null : newest.text);
        }
    }
}
