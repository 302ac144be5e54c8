import { MODE_REASONS, MODES, PI_MODES } from "./schema.js";
import * as validate from "./validate.js";

/** What a ground may select of an aircraft that does not report it. */
const BOARD_MODES = ["RATE", "FBW"];
const MAX_MODES = 32;
const MAX_NAME = 24;

/** The flight mode that acts: that of the Raspberry Pi while it flies, otherwise the board's; null: unknown. */
export function actingMode(store) {
  const board = store.text("flight_mode");
  return isFlownByPi(board) ? (store.text("flight_control.mode") ?? board) : board;
}

/** mode: of the board. */
export function isFlownByPi(mode) {
  return PI_MODES.includes(mode);
}

/** The Arduino's modes that a ground may select. */
export function boardModes(store) {
  return named(store.texts("flight_control.board_modes") ?? BOARD_MODES);
}

/**
 * The flight modes of the Raspberry Pi: {name: code}; a code of MODE_REASONS says why a mode is not
 * offered, null: it is. Null: the aircraft does not report them.
 */
export function piModes(store) {
  const found = validate.at(store.data, "flight_control.modes");
  if (found === null || typeof found !== "object" || Array.isArray(found)) {
    return null;
  }
  return new Map(
    named(Object.keys(found)).map((name) => [name, found[name] === null ? null : String(found[name])]),
  );
}

/** code: why a flight mode is not offered, or was replaced; unknown ones are shown as they are. */
export function modeReason(code) {
  return Object.hasOwn(MODE_REASONS, code) ? MODE_REASONS[code] : code;
}

/** Who controls the aircraft: the pilot, the Arduino, the Raspberry Pi; empty: unknown. */
export function controllerText(store) {
  const board = store.text("flight_mode");
  if (!Object.hasOwn(MODES, board)) {
    return "";
  }
  const isPi = isFlownByPi(board);
  if (store.flag("arduino.failsafe") === true && !isPi) {
    return "Arduino (failsafe)";
  }
  const own = isPi ? store.text("flight_control.mode") : null;
  // In its FBW the pilot steers, and the Raspberry Pi does what the Arduino does in that of the board.
  const steered = Object.hasOwn(MODES, own) ? MODES[own].holder : "";
  return steered === "" ? MODES[board].holder : steered.replace("Arduino", "Raspberry Pi");
}

function named(names) {
  return names.filter((each) => each !== "").slice(0, MAX_MODES).map((each) => each.slice(0, MAX_NAME));
}
