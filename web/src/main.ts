/** The page begins here: buttons and keys are tied to what they do; programs find `window.singletrack`. */

import "./style.css";
import { curvesOf } from "./answers";
import { byId } from "./elements";
import { csv, figure, save } from "./exports";
import { Page } from "./page";
import { writeRecords } from "./records";
import { STORIES } from "./stories";

declare global {
  interface Window {
    singletrack: {
      set(changes: Record<string, unknown>): void;
      result(): Record<string, unknown>;
      undo(): void;
      lastRedraw(): number;
    };
  }
}

const dark = matchMedia("(prefers-color-scheme: dark)").matches;
document.documentElement.dataset.scheme = dark ? "dark" : "light";
const page = new Page();
const KMH = 3.6;

window.singletrack = {
  set: (changes) => page.change(changes),
  result: () => page.result(),
  undo: () => page.undo(),
  lastRedraw: () => page.lastRedraw,
};

for (const name of ["bicycle", "rider", "posture", "arms"]) {
  const select = byId<HTMLSelectElement>(name);
  select.addEventListener("change", () => page.change({ [name]: select.value }));
}
const lean = byId<HTMLInputElement>("torso-lean");
lean.addEventListener("change", () => page.change({ torso_lean: lean.checked }));

const speed = byId<HTMLInputElement>("speed");
const speedNumber = byId<HTMLInputElement>("speed-number");
const speedUnit = byId<HTMLSelectElement>("speed-unit");
speed.addEventListener("input", () => page.change({ speed: Number(speed.value) }));
speedNumber.addEventListener("change", () => {
  const value = Number(speedNumber.value);
  if (Number.isFinite(value)) page.change({ speed: speedUnit.value === "km/h" ? value / KMH : value });
});
speedUnit.addEventListener("change", () => page.change({ speed: page.current.design.speed }));

const play = byId("play");
const togglePlay = () => {
  page.rides.playing = !page.rides.playing;
  play.textContent = page.rides.playing ? "pause" : "play";
  play.setAttribute("aria-pressed", String(page.rides.playing));
};
play.textContent = page.rides.playing ? "pause" : "play";
play.addEventListener("click", togglePlay);
byId("kick").addEventListener("click", () => page.rides.kick());
const pace = byId<HTMLInputElement>("pace");
pace.addEventListener("input", () => (page.rides.pace = Number(pace.value)));
const follow = byId<HTMLInputElement>("follow");
follow.addEventListener("change", () => (page.rides.follows = follow.checked));

byId("undo").addEventListener("click", () => page.undo());
byId("reset").addEventListener("click", () => page.reset());
byId("pin").addEventListener("click", () => page.pin());
byId("scheme").addEventListener("click", () => {
  const root = document.documentElement;
  root.dataset.scheme = root.dataset.scheme === "dark" ? "light" : "dark";
  page.refresh();
});

addEventListener("keydown", (event) => {
  const typing = event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement;
  if ((event.ctrlKey || event.metaKey) && event.key === "z" && !typing) page.undo();
  else if (typing || event.ctrlKey || event.metaKey) return;
  else if (event.key === " " && !(event.target instanceof HTMLButtonElement)) togglePlay();
  else if (event.key === "ArrowRight") page.change({ speed: Math.min(page.current.design.speed + 0.1, 10) });
  else if (event.key === "ArrowLeft") page.change({ speed: Math.max(page.current.design.speed - 0.1, 0) });
  else return;
  event.preventDefault();
});
addEventListener("hashchange", () => location.reload());

const title = () => `${page.current.design.bicycle}${page.current.design.rider ? `, ${page.current.design.rider}, ${page.current.design.posture}` : ""}`;
byId("save-toml").addEventListener("click", () => {
  for (const { name, text } of writeRecords(page.current.design)) save(name, text, "application/toml");
});
byId("save-csv").addEventListener("click", () => save("eigenvalues.csv", csv(curvesOf(page.current)), "text/csv"));
byId("save-svg").addEventListener("click", () => save("eigenvalues.svg", figure(curvesOf(page.current), title()), "image/svg+xml"));
byId("save-png").addEventListener("click", async () => {
  const blob = await page.png();
  if (blob) save("eigenvalues.png", blob);
});
byId("copy-link").addEventListener("click", () => navigator.clipboard?.writeText(location.href).catch(() => undefined));

addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  for (const file of event.dataTransfer?.files ?? []) void page.drop(file);
});

const told = document.createElement("p");
told.id = "told";
told.setAttribute("aria-live", "polite");
byId("stories").append(
  ...STORIES.map((story) => {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", className: "story", textContent: story.title });
    button.addEventListener("click", () => {
      page.reset();
      page.change(story.set);
      if (story.motion === "kick") page.rides.kick();
      else page.rides.only(story.motion);
      told.textContent = story.text;
    });
    return button;
  }),
  told,
);
