import { keepsakeOf } from "./link/keepsake.js";
import { isAcknowledged } from "./panels/acknowledged.js";

const LEVELS = ["none", "info", "warning", "alarm"];
const TONES = {
  warning: { pitches_hz: [660], gap_s: 0.3, vibrate_ms: [200] },
  alarm: { pitches_hz: [880, 660, 880], gap_s: 0.16, vibrate_ms: [300, 100, 300] },
};
const AGAIN_S = 6;

/**
 * Tones and vibration for alarms: when one appears, and again while the worst stands.
 * Silent until the user switches it on; browsers play nothing before a gesture.
 * @param {HTMLButtonElement} button
 * @param {object} store
 */
export function mountSound(button, store) {
  const memory = keepsakeOf("localStorage");
  let isOn = memory.get("sound") === "on";
  let context = null;
  let known = new Set();
  let soundedAt_s = -Infinity;
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
  button.addEventListener("click", () => {
    isOn = !isOn;
    memory.set("sound", isOn ? "on" : "off");
    unlock();
    show();
    if (isOn) {
      play(context, { pitches_hz: [660], gap_s: 0.2, vibrate_ms: [50] });
    }
  });
  document.addEventListener("pointerdown", unlock);
  document.addEventListener("keydown", unlock);
  store.subscribe(() => {
    const level = worstLevel(store.alarms.filter((each) => !isAcknowledged(each)));
    const now = new Set(store.alarms.map((each) => `${each.kind} ${each.level}`));
    const isNew = [...now].some((each) => !known.has(each));
    known = now;
    const isDue = level === "alarm" && store.now_s - soundedAt_s > AGAIN_S;
    if (isOn && TONES[level] !== undefined && (isNew || isDue)) {
      soundedAt_s = store.now_s;
      play(context, TONES[level]);
    }
  });
  show();
}

/**
 * @param {{level: string}[]} alarms
 * @returns {"none"|"info"|"warning"|"alarm"}
 */
export function worstLevel(alarms) {
  const worst = Math.max(0, ...alarms.map((each) => LEVELS.indexOf(each?.level)));
  return LEVELS[worst];
}

function play(context, { pitches_hz, gap_s, vibrate_ms }) {
  navigator.vibrate?.(vibrate_ms);
  if (context === null || context.state !== "running") {
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
