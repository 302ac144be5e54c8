import { showReason } from "./disabled_reason.js";
import { html } from "../dom.js";
import { Arming } from "./arming.js";
import { CommandSender } from "./command_sender.js";
import { FlightModes } from "./flight_modes.js";
import { RequestForm } from "./request_form.js";

export function mount(place, store, connection) {
  const sender = new CommandSender(store, connection);
  const last = html("p", { id: "last-answer", role: "status", "data-look": "plain" });
  const why = html("p.why", { id: "commands-why" });
  const parts = [new FlightModes(store, sender), new Arming(store, sender), new RequestForm(store, sender)];
  place.append(why, last, ...parts.map((part) => part.element));
  return {
    update() {
      place.hidden = connection.welcome?.is_replay === true;
      // The action with the most conditions has the fullest reason: a missing role shows here too.
      showReason(why, sender.disabledReason("up.flight_mode.set") ?? sender.disabledReason("up.arm"));
      parts.forEach((part) => part.update());
    },
  };
}
