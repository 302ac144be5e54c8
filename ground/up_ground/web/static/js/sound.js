import { TIMERS } from "./link/clock.js";
import { storageOf } from "./link/storage.js";
import { keyOf, soundingAlarms } from "./state/alarm_level.js";

const TONES = {
  warning: { pitches_hz: [660], gap_s: 0.3, vibrate_ms: [200] },
  alarm: { pitches_hz: [880, 660, 880], gap_s: 0.16, vibrate_ms: [300, 100, 300] },
  test: { pitches_hz: [660], gap_s: 0.15, vibrate_ms: [50] },
};
const REPEAT_S = 6;
const POLL_S = 0.5;

/** Decides when to ring: at a new alarm, and every 6 s while one is active. */
export class Bell {
  #known = new Set();
  #rang_s = -Infinity;

  /** alarm: the worst, or what the page itself detects; all: of the aircraft. Returns the sound to play. */
  ring(alarm, all, now_s) {
    const now = new Set(all.map(keyOf));
    if (all.length === 0 || alarm.level === "alarm") {
      now.add(`${alarm.text} ${alarm.level}`);
    }
    const isNew = [...now].some((each) => !this.#known.has(each));
    const isAgain = alarm.level === "alarm" && now_s - this.#rang_s >= REPEAT_S;
    this.#known = now;
    if ((alarm.level !== "alarm" && alarm.level !== "warning") || !(isNew || isAgain)) {
      return null;
    }
    this.#rang_s = now_s;
    return alarm.level;
  }
}

/**
 * Tones and vibration for alarms; silent until the user switches them on, because browsers play
 * nothing before a gesture. Driven by a timer, so that a page in the background rings too.
 */
export function mountSound(button, store, connection) {
  const memory = storageOf("localStorage");
  const bell = new Bell();
  let isOn = memory.get("sound") === "on";
  let context = null;
  const unlock = () => {
    if (isOn && context === null && globalThis.AudioContext) {
      context = new AudioContext();
    }
    context?.resume?.();
  };
  const show = () => {
    button.textContent = isOn ? "Sound on" : "Sound off";
    button.setAttribute("aria-pressed", String(isOn));
  };
  const look = () => {
    const { alarm, all } = soundingAlarms(store, connection);
    const level = bell.ring(alarm, all, store.now_s);
    if (isOn && level !== null) {
      play(context, TONES[level]);
    }
  };
  button.addEventListener("click", () => {
    isOn = !isOn;
    memory.set("sound", isOn ? "on" : "off");
    unlock();
    show();
    if (isOn) {
      play(context, TONES.test);
    }
  });
  document.addEventListener("pointerdown", unlock);
  document.addEventListener("keydown", unlock);
  connection.on("alarms", look);
  connection.on("fleet", look);
  TIMERS.each(look, POLL_S);
  show();
}

function play(context, { pitches_hz, gap_s, vibrate_ms }) {
  navigator.vibrate?.(vibrate_ms);
  if (context === null || context.state === "closed") {
    return;
  }
  pitches_hz.forEach((pitch_hz, place) => {
    const begin_s = context.currentTime + place * gap_s;
    const tone = context.createOscillator();
    const volume = context.createGain();
    tone.type = "triangle";
    tone.frequency.value = pitch_hz;
    volume.gain.setValueAtTime(0, begin_s);
    volume.gain.linearRampToValueAtTime(0.25, begin_s + 0.01);
    volume.gain.linearRampToValueAtTime(0, begin_s + gap_s * 0.9);
    tone.connect(volume).connect(context.destination);
    tone.start(begin_s);
    tone.stop(begin_s + gap_s);
  });
}
