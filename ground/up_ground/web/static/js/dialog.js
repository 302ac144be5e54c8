/** Confirm an important action. Returns false also for Escape, and while another dialog is open. */
export function confirm({ title, text, yes = "Yes", no = "No", isDanger = false }) {
  const dialog = document.getElementById("confirm");
  if (dialog.open) {
    return Promise.resolve(false);
  }
  document.getElementById("confirm-title").textContent = title;
  document.getElementById("confirm-text").textContent = text;
  const yesButton = document.getElementById("confirm-yes");
  const noButton = document.getElementById("confirm-no");
  yesButton.textContent = yes;
  noButton.textContent = no;
  yesButton.classList.toggle("danger", isDanger);
  const sender = document.activeElement;
  return new Promise((resolve) => {
    const quit = new AbortController();
    let answer = false;
    const end = (isYes) => {
      answer = isYes;
      dialog.close();
    };
    const when = { signal: quit.signal };
    yesButton.addEventListener("click", () => end(true), when);
    noButton.addEventListener("click", () => end(false), when);
    dialog.addEventListener(
      "close",
      () => {
        quit.abort();
        sender?.focus?.();
        resolve(answer);
      },
      when,
    );
    dialog.showModal();
    noButton.focus();
  });
}
