import { keepsakeOf } from "./link/keepsake.js";

const THEMES = ["dark", "daylight"];

/**
 * Dark or daylight: follows the system until the user chooses. button: toggles; its label names the
 * other theme.
 */
export function mountTheme(button) {
  const memory = keepsakeOf("localStorage");
  const system = matchMedia("(prefers-color-scheme: light)");
  const chosen = () => (THEMES.includes(memory.get("theme")) ? memory.get("theme") : null);
  const show = () => {
    const theme = chosen() ?? (system.matches ? "daylight" : "dark");
    document.documentElement.dataset.theme = theme;
    button.textContent = theme === "dark" ? "Daylight" : "Dark";
    document.dispatchEvent(new CustomEvent("up-theme", { detail: theme }));
  };
  button.addEventListener("click", () => {
    memory.set("theme", document.documentElement.dataset.theme === "dark" ? "daylight" : "dark");
    show();
  });
  system.addEventListener("change", show);
  show();
}
