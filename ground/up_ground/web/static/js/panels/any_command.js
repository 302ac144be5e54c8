import { html, setText } from "../dom.js";
import { KnownFields, UnknownFields } from "./command_form.js";
import { CommandSender, showNote } from "./command_sender.js";
import { nameReason, showReason, warningOf } from "./disabled_reason.js";
import { nameProblem } from "./field_value.js";

const MAX_SHOWN = 600;

/** Every Command that the server knows, and by name those that it does not. */
export function mount(place, store, connection) {
  const sender = new CommandSender(store, connection);
  const why = html("p.why", { id: "any-why" });
  const names = html("datalist", { id: "any-names" });
  const input = html("input", {
    id: "any-name",
    type: "text",
    list: "any-names",
    autocomplete: "off",
    autocapitalize: "off",
    spellcheck: "false",
    placeholder: "type its name",
    "aria-describedby": "any-about any-note",
    on: { input: () => choose() },
  });
  const about = html("p.quiet", { id: "any-about" });
  const fields = html("div");
  const send = html("button", { type: "submit", id: "any-send", text: "Send" });
  const note = html("p.note", { id: "any-note", role: "status" });
  const form = html(
    "form",
    { novalidate: true, on: { submit: (event) => submit(event) } },
    html("div.field", {}, html("label", { for: "any-name", text: "Command" }), input, names),
    about,
    fields,
    html("div.row", {}, send),
    note,
  );
  const details = html("details", { id: "any-command" }, html("summary", {}, place.querySelector("h2")), why, form);
  place.append(details);
  let offered = null;
  let offeredWords = "";
  let aircraft = store.aircraft;
  let chosen = { name: "", command: null, part: null };

  function list() {
    const { commands } = store.catalogue;
    const words = JSON.stringify(commands);
    // After a lost connection the same ones arrive again: the input stays.
    if (words !== offeredWords && commands.length > 0) {
      offeredWords = words;
      names.replaceChildren(...commands.map(({ name }) => html("option", { value: name })));
      chosen = { name: "", command: null, part: null };
      fields.replaceChildren();
      choose();
    }
  }

  function choose() {
    const name = input.value.trim();
    const command = store.catalogue.get(name);
    if (name === chosen.name && command === chosen.command) {
      return;
    }
    // While an unknown name is typed on, its fields stay.
    const isSame = chosen.part !== null && command === null && chosen.command === null && name !== "";
    const part = isSame ? chosen.part : name === "" ? null : partOf(command);
    chosen = { name, command, part };
    if (!isSame) {
      fields.replaceChildren(...(part === null ? [] : [part.element]));
    }
    setText(about, aboutText(name, command));
    setText(note, "");
    offer();
  }

  function reasonNow(data = null) {
    const name = chosen.command?.name ?? chosen.name;
    return nameReason(store, sender, name === "" ? "up.flight_mode.set" : name, data);
  }

  // The input was meant for the aircraft watched before.
  function follow() {
    if (store.aircraft !== aircraft) {
      aircraft = store.aircraft;
      input.value = "";
      choose();
    }
  }

  function offer() {
    const reason = reasonNow();
    showReason(why, reason);
    chosen.part?.offer(reason === null);
    send.disabled = reason !== null || chosen.part === null;
  }

  async function submit(event) {
    event.preventDefault();
    const { name, command, part } = chosen;
    if (part === null || reasonNow() !== null) {
      return;
    }
    const problem = command === null ? nameProblem(name) : "";
    const data = problem ? null : part.read();
    const reason = data === null ? { code: "invalid", text: problem } : reasonNow(data);
    if (reason !== null) {
      showNote(note, reason.text, "bad", reason.code);
      return;
    }
    const sent = command?.name ?? name;
    const warning = warningOf(store, sent, data);
    await sender.send(sent, data, {
      note,
      question: questionOf(sent, data, command, warning),
      isForced: command === null,
    });
  }

  return {
    update() {
      place.hidden = connection.welcome?.is_replay === true;
      follow();
      if (!details.open) {
        return;
      }
      if (store.catalogue !== offered) {
        offered = store.catalogue;
        list();
      }
      offer();
    },
  };
}

function partOf(command) {
  return command === null ? new UnknownFields() : new KnownFields(command);
}

function aboutText(name, command) {
  if (name === "") {
    return "";
  }
  if (command === null) {
    return "Unknown to this ground station; the aircraft may have it.";
  }
  const special = command.roleWhere.map(({ field, value, role }) => `; ${field} ${value}: ${role} or more`);
  const role = ` [${command.role} or more${special.join("")}]`;
  const alias = name === command.name ? "" : `${command.name}: `;
  return `${alias}${command.text}${role}`;
}

/** command: null: unknown here; warning: shown before sending. */
export function questionOf(name, data, command, warning = "") {
  const written = JSON.stringify(data);
  const shown = written.length > MAX_SHOWN ? `${written.slice(0, MAX_SHOWN)}...` : written;
  const lines = [written === "{}" ? "Without fields." : shown, warning].filter(Boolean).join("\n\n");
  return command !== null
    ? { title: `Send ${name}?`, text: `${command.text}\n\n${lines}`, yes: "Send", no: "Do not send", isDanger: false }
    : {
        title: `Send ${name} unchecked?`,
        text: `Unknown to this ground station: its name and fields are unchecked. If the aircraft has this Command, it executes it.\n\n${lines}`,
        yes: "Send unchecked",
        no: "Do not send",
        isDanger: true,
      };
}
