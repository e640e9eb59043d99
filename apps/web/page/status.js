"use strict";
// What the render is doing, as the program tells it, and the controls that hold and end it.

const RETRY_SECONDS = [1, 2, 3, 4, 5, 5, 10, 10, 20];  // after a lost connection, a minute in all
const RETRIES_AFTER_THE_END = 2;                       // where the render had finished, the program has most likely ended
const PHASES = {trials: "Trying numbers of photons and samples", photons: "Tracing photons", build: "Building photon maps", render: "Rendering"};
const SURE_SECONDS = 5;                                // for the second press of the button that ends the render

// Follows /events. onStatus(status); onLost(whether it tries again); onBack().
class Connection {
  constructor(hooks) {
    this.hooks = hooks;
    this.tries = 0;
    this.finished = false;
    this.lost = false;
    this.open();
  }

  open() {
    clearTimeout(this.timer);
    this.source?.close();
    this.source = new EventSource("events");
    this.source.addEventListener("status", event => {
      const status = JSON.parse(event.data);
      if (this.lost) this.hooks.onBack();
      this.lost = false;
      this.tries = 0;
      this.finished = status.state === "finished";
      this.hooks.onStatus(status);
    });
    this.source.addEventListener("error", () => this.retry());
  }

  // In place of EventSource's own retries, which never end.
  retry() {
    this.source.close();
    this.lost = true;
    const seconds = RETRY_SECONDS[this.tries++];
    const again = seconds !== undefined && !(this.finished && this.tries > RETRIES_AFTER_THE_END);
    this.hooks.onLost(again);
    if (again) this.timer = setTimeout(() => this.open(), 1000 * seconds);
  }

  tryAgain() {
    this.tries = 0;
    this.hooks.onLost(true);
    this.open();
  }
}

// The panel of the render's progress. hooks: savePng() where the program is gone.
class StatusPanel {
  constructor(title, hooks) {
    this.title = title;
    this.hooks = hooks;
    this.status = null;
    this.lost = null;       // null, "trying" or "gone"
    this.told = "";
    byId("pause").addEventListener("click", () => this.pause());
    byId("stop").addEventListener("click", () => this.stop());
    byId("again").addEventListener("click", () => this.hooks.tryAgain());
    byId("save-png").addEventListener("click", event => {
      if (!this.lost) return;
      event.preventDefault();
      this.hooks.savePng();
    });
    byId("save-exr").addEventListener("click", event => { if (this.lost) event.preventDefault(); });
  }

  get state() { return this.status?.state ?? "waiting"; }

  notice(status) {
    const fresh = this.status?.render !== status.render;
    this.status = status;
    if (fresh || this.curveLength !== status.errors.length) drawCurve(byId("curve"), status.errors);
    this.curveLength = status.errors.length;
    this.show();
  }

  connection(lost) {
    this.lost = lost;
    this.show();
  }

  async pause() {
    if (this.lost || !this.status || this.state === "finished") return;
    await this.ask(this.state === "paused" ? "resume" : "pause");
  }

  // Ends the render with the second press, since it cannot be taken back.
  async stop() {
    if (this.lost || !this.status || this.state === "finished" || this.status.stopped) return;
    if (!this.sure) {
      this.sure = setTimeout(() => { this.sure = null; this.show(); }, 1000 * SURE_SECONDS);
      this.show();
      announce("Press again to end the render; what it has is kept.");
      return;
    }
    clearTimeout(this.sure);
    this.sure = null;
    await this.ask("stop");
    this.show();
  }

  async ask(path) {
    try {
      await request(path, {method: "POST"});
      byId("control-problem").textContent = "";
    } catch (problem) {
      byId("control-problem").textContent = `The program did not do that: ${problem.message}`;
    }
  }

  // In words, for the chip in the head of the page.
  stateText() {
    const {status} = this;
    if (this.lost) return this.lost === "trying" ? "connection lost" : this.state === "finished" ? "ended" : "not connected";
    if (!status) return "connecting";
    if (status.state === "finished") return status.trouble ? "failed" : status.stopped ? "stopped" : "finished";
    if (status.stopped) return "stopping";
    return status.state === "paused" ? "paused" : "running";
  }

  // A render that has finished has, with its program or without it.
  colourState() { return this.lost && this.state !== "finished" ? "lost" : this.state; }

  phaseText() {
    const {phase, pass, passes, state} = this.status;
    if (state === "finished" && this.status.trouble) return `Not rendered: ${this.status.trouble}`;
    if (state === "finished") return this.status.stopped ? "Stopped with what it had" : "Finished";
    const name = PHASES[phase] ?? (phase || "Starting");
    return passes === 1 || phase === "trials" || !phase ? name : `${name}, pass ${pass}${passes ? ` of ${passes}` : ""}`;
  }

  show() {
    const {status} = this, text = this.stateText();
    const chip = byId("state");
    if (chip.textContent !== text) chip.textContent = text;
    chip.dataset.state = this.colourState();
    if (this.told !== text) announce(`${this.title}: ${text}`);
    this.told = text;
    this.showConnection();
    if (status) this.showProgress();
    const running = !this.lost && status && status.state !== "finished";
    byId("pause").disabled = !running || status.stopped;
    byId("pause").textContent = this.state === "paused" ? "Resume" : "Pause";
    byId("stop").disabled = !running || status.stopped;
    byId("stop").textContent = this.sure ? "Really stop?" : "Stop and keep";
    byId("stop").classList.toggle("sure", Boolean(this.sure));
    byId("save-exr").setAttribute("aria-disabled", String(Boolean(this.lost)));
  }

  showConnection() {
    const note = byId("lost");
    note.hidden = !this.lost;
    byId("again").hidden = this.lost !== "gone";
    byId("lost-text").textContent = this.lost === "trying" ? "The connection to the program is lost. Trying again."
      : this.state === "finished" ? "The program has ended. This page keeps the picture."
      : "The program does not answer; it has probably ended. This page keeps the last picture that it received.";
  }

  showProgress() {
    const {status} = this, whole = Math.round(1000 * clamp(status.fraction, 0, 1)) / 10, bar = byId("progress");
    bar.style.setProperty("--done", `${whole}%`);
    bar.dataset.state = this.colourState();
    bar.setAttribute("aria-valuenow", String(Math.floor(whole)));
    bar.setAttribute("aria-valuetext", `${Math.floor(whole)} percent, ${this.phaseText()}`);
    byId("phase").textContent = this.phaseText();
    byId("percent").textContent = `${whole < 10 ? whole.toFixed(1) : Math.floor(whole)} %`;
    byId("elapsed").textContent = durationText(status.seconds);
    const left = status.seconds_left;
    byId("left").textContent = status.state === "finished" || this.lost ? "\u2013"
      : left === null ? "not known yet" : durationText(left);
    const last = status.errors.at(-1);
    byId("error").textContent = last ? percent(last[2]) : "\u2013";
    const done = status.state === "finished" ? "" : `${Math.floor(whole)} % `;
    document.title = `${this.lost ? "" : done}${this.title}`;
  }
}
