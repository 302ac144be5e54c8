import { html, setAttribute, setText } from "../dom.js";
import { clockText } from "./messages.js";

const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 30];
const STEP_S = 5;

/** Plays a flight of the past: play and pause, speed, where in time; by keys k, j, l as well. */
export function mount(place, store, connection) {
  const play = html("button", { type: "button", id: "replay-play", on: { click: toggle } });
  const slider = html("input", {
    type: "range",
    id: "replay-time",
    min: 0,
    max: 1,
    step: 0.1,
    "aria-label": "Time in the flight",
  });
  const speed = html("select", { id: "replay-speed", "aria-label": "Speed" });
  speed.append(...SPEEDS.map((each) => html("option", { value: each, text: `${each} ×` })));
  const time = html("output", { for: "replay-time" });
  const name = html("p.quiet", { id: "replay-name" });
  place.append(html("div.replay-bar", {}, play, slider, time, speed), name);
  let isDragged = false;

  slider.addEventListener("input", () => {
    isDragged = true;
    seek(Number(slider.value));
  });
  for (const event of ["change", "pointerup", "blur"]) {
    slider.addEventListener(event, () => (isDragged = false));
  }
  speed.addEventListener("change", () => send("speed", Number(speed.value)));
  document.addEventListener("keydown", onKey);

  function send(action, value = null) {
    connection.send({ type: "replay", aircraft: store.aircraft, action, value });
  }

  function toggle() {
    send(store.replay?.is_playing ? "pause" : "play");
  }

  function seek(time_s) {
    const length_s = store.replay?.length_s ?? 0;
    send("seek", Math.max(0, Math.min(length_s, time_s)));
  }

  function onKey(event) {
    const isTyping = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName);
    if (store.replay === null || isTyping || event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const keys = {
      k: toggle,
      j: () => seek(store.replay.time_s - STEP_S),
      l: () => seek(store.replay.time_s + STEP_S),
    };
    if (Object.hasOwn(keys, event.key)) {
      event.preventDefault();
      keys[event.key]();
    }
  }

  return {
    update() {
      const replay = store.replay;
      place.hidden = replay === null;
      if (replay === null) {
        return;
      }
      const spoken = `${clockText(replay.time_s)} of ${clockText(replay.length_s)}`;
      setText(play, replay.is_playing ? "Pause" : "Play");
      setAttribute(play, "data-playing", String(replay.is_playing));
      setText(name, `Replay of ${replay.name}: not live.`);
      setText(time, isDragged ? `${clockText(Number(slider.value))} of ${clockText(replay.length_s)}` : spoken);
      setAttribute(slider, "max", String(replay.length_s));
      setAttribute(slider, "aria-valuetext", spoken);
      if (!isDragged) {
        slider.value = String(replay.time_s);
      }
      if (document.activeElement !== speed) {
        speed.value = String(nearestSpeed(replay.speed));
      }
    },
  };
}

function nearestSpeed(wanted) {
  return SPEEDS.reduce((best, each) =>
    Math.abs(each - wanted) < Math.abs(best - wanted) ? each : best,
  );
}
