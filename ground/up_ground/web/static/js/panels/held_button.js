import { html, setAttribute, svg } from "../dom.js";
import { OTHER_AIRCRAFT, showNote } from "./command_sender.js";
import { HeldPress, HOLD_S } from "./held_press.js";

const ROUND = 2 * Math.PI * 15;
const KEYS = new Set([" ", "Enter"]);
const LEFT = { code: "pointer_left", text: "the pointer left the button" };
const UNFOCUSED = { code: "unfocused", text: "the focus moved elsewhere" };

/**
 * A button that acts only when it is held, by pointer, touch or key.
 *
 * `disabledReason()` returns why it may not be pressed now, {code, text} or null; it is called
 * throughout the press. A
 * disabled button ignores presses too: browsers deliver pointer events to it all the same. `fire()`
 * is called once when the press has lasted long enough, for the aircraft of its beginning:
 * `aircraft()` returns the selected one. `note` shows why a press did not.
 */
export class HeldButton {
  #press = new HeldPress();
  #disabledReason;
  #fire;
  #clock_s;
  #ring;
  #note;
  #isLooking = false;
  #selected;
  #aircraft = null;

  constructor({ id, text, disabledReason, fire, now_s, note, aircraft }) {
    this.#note = note;
    this.#selected = aircraft;
    this.#disabledReason = disabledReason;
    this.#fire = fire;
    this.#clock_s = now_s;
    this.#ring = svg("circle.ring-done", { cx: 18, cy: 18, r: 15, "stroke-dasharray": ROUND });
    const ring = svg(
      "svg.ring",
      { viewBox: "0 0 36 36", "aria-hidden": "true" },
      svg("circle.ring-whole", { cx: 18, cy: 18, r: 15 }),
      this.#ring,
    );
    this.button = html(
      "button.held",
      { id, type: "button", "aria-describedby": `${id}-how` },
      ring,
      html("span", { text }),
    );
    this.how = html("span.hidden-text", {
      id: `${id}-how`,
      text: `Hold for ${HOLD_S} seconds; with the keyboard hold Space or Enter. Releasing it earlier does nothing.`,
    });
    this.#listen();
    this.#show();
  }

  /** Cancel a press under way when there is an objection, and show the state. */
  update() {
    if (this.#press.state === "pressed") {
      this.#look();
    }
    this.#show();
  }

  #listen() {
    const button = this.button;
    const now_s = () => this.#clock_s();
    button.addEventListener("pointerdown", (event) => {
      if (event.button === 0 || event.pointerType === "touch") {
        this.#begin(`pointer ${event.pointerId}`, now_s());
      }
    });
    // A finger is captured by the first element it touched: only its position shows that it left.
    button.addEventListener("pointermove", (event) => {
      if (this.#press.state === "pressed" && !isWithin(event, button)) {
        this.#end(() => this.#press.void(LEFT));
      }
    });
    button.addEventListener("pointerleave", () => this.#abandon(LEFT));
    button.addEventListener("pointercancel", () => this.#abandon({ code: "touch_cancelled", text: "the touch was interrupted" }));
    button.addEventListener("contextmenu", (event) => event.preventDefault());
    button.addEventListener("keydown", (event) => {
      if (KEYS.has(event.key)) {
        event.preventDefault();
        if (!event.repeat) {
          this.#begin(`key ${event.key}`, now_s());
        }
      } else if (event.key === "Escape") {
        this.#end(() => this.#press.void({ code: "escape", text: "Escape was pressed" }));
      }
    });
    button.addEventListener("keyup", (event) => {
      if (KEYS.has(event.key)) {
        event.preventDefault();
      }
    });
    // The release may happen elsewhere: a button that became disabled gets no more key events.
    window.addEventListener("pointerup", ({ pointerId }) => this.#release(`pointer ${pointerId}`), true);
    window.addEventListener("keyup", ({ key }) => this.#release(`key ${key}`), true);
    button.addEventListener("blur", () => this.#abandon(UNFOCUSED));
    window.addEventListener("blur", () => this.#abandon(UNFOCUSED));
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) {
        this.#abandon({ code: "hidden", text: "the page was hidden" });
      }
    });
  }

  #begin(by, now_s) {
    this.#aircraft = this.#press.state === "idle" ? this.#selected() : this.#aircraft;
    this.#press.press(by, now_s, this.#reason());
    const isPressed = this.#press.state === "pressed";
    if (isPressed) {
      showNote(this.#note, "keep holding", "plain", "pressed");
    } else {
      this.#showVoid();
    }
    if (isPressed && !this.#isLooking) {
      this.#isLooking = true;
      requestAnimationFrame(() => this.#tick());
    }
    this.#show();
  }

  #tick() {
    this.#look();
    this.#show();
    this.#isLooking = this.#press.state === "pressed";
    if (this.#isLooking) {
      requestAnimationFrame(() => this.#tick());
    }
  }

  #look() {
    this.#end(() => {
      if (this.#press.update(this.#clock_s(), this.#reason())) {
        this.#fire();
      }
    });
  }

  #reason() {
    if (this.#selected() !== this.#aircraft) {
      return OTHER_AIRCRAFT;
    }
    const reason = this.#disabledReason();
    if (reason !== null) {
      return reason;
    }
    if (this.button.closest("[inert]") !== null) {
      return { code: "part_failed", text: "this part of the page has failed" };
    }
    return this.button.disabled ? { code: "disabled", text: "it is not offered now" } : null;
  }

  #release(by) {
    if (this.#press.state !== "idle") {
      this.#end(() => this.#press.release(by));
    }
  }

  #abandon(reason) {
    if (this.#press.state !== "idle") {
      this.#end(() => this.#press.abandon(reason));
    }
  }

  #end(change) {
    const wasPressed = this.#press.state === "pressed";
    change();
    if (wasPressed && this.#press.state !== "pressed" && this.#press.state !== "done") {
      this.#showVoid();
    }
    this.#show();
  }

  #showVoid() {
    const { code, text } = this.#press.reason;
    showNote(this.#note, `not sent: ${text}`, "plain", code);
  }

  #show() {
    const progress = this.#press.progress(this.#clock_s());
    setAttribute(this.button, "data-press", this.#press.state);
    setAttribute(this.button, "data-progress", progress.toFixed(2));
    setAttribute(this.#ring, "stroke-dashoffset", (ROUND * (1 - progress)).toFixed(1));
  }
}

function isWithin(event, button) {
  const { left, right, top, bottom } = button.getBoundingClientRect();
  return (
    event.clientX >= left && event.clientX <= right && event.clientY >= top && event.clientY <= bottom
  );
}
