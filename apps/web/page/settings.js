"use strict";
// The settings of the laboratory: a change of one renders again at once.

const RENDER_AFTER = 500;   // milliseconds after the last change of a setting
const SLIDER_STEPS = 40;    // of a setting's slider, from 1/32 to 32 times its first value

// A number with the suffix of its writing: counts (500k), multiples (0.5x) and plain numbers. "auto" counts as 1x.
function numberOf(text) {
  if (text === "auto") return {value: 1, multiple: true, write: x => x === 1 ? "auto" : `${short(x)}x`};
  const parts = /^([0-9.]+(?:e[-+]?\d+)?)([kMGx]?)$/.exec(text.trim());
  if (!parts || !(Number(parts[1]) > 0)) return null;
  const factor = {"": 1, k: 1e3, M: 1e6, G: 1e9, x: 1}[parts[2]];
  const write = parts[2] === "x" ? x => `${short(x)}x` : parts[2] || /^\d{4,}$/.test(parts[1])
    ? x => countText(Math.round(x)) : Number.isInteger(Number(text)) ? x => String(Math.max(1, Math.round(x))) : short;
  return {value: Number(parts[1]) * factor, multiple: parts[2] === "x", write};
}

// 300000 as 300k, if that is the same number.
function shortened(text) {
  const number = Number(text), written = countText(number);
  return /^\d+000$/.test(text) && numberOf(written)?.value === number ? written : text;
}

class Settings {
  // onRender(names and values): before the program is asked to render with them.
  constructor(settings, onRender) {
    this.onRender = onRender;
    this.fields = new Map();
    this.changed = new Map();   // what the user has changed so far
    for (const setting of settings) byId("settings").append(this.field(setting));
    this.begin();
  }

  field(setting) {
    const id = `setting-${setting.name}`, help = make("span", {id: `${id}-doc`, class: "doc"}, setting.doc ?? "");
    const unit = setting.unit && setting.unit.length < 4 ? ` [${setting.unit}]` : "";  // longer ones repeat the name
    const label = make("label", {for: id, title: setting.doc ?? ""}, setting.name + unit);
    const changed = () => this.change(setting.name, input.value);
    let input, slider = null;
    if (setting.choices.length) {
      input = make("select", {id, change: changed}, ...setting.choices.map(c => new Option(c, c)));
      // A value that is not given follows from other settings, or is the default.
      const {value} = setting;
      if (!setting.choices.includes(value)) input.prepend(new Option(value || setting.default || "default", value));
      input.value = setting.value;
    } else {
      input = make("input", {id, type: "text", value: shortened(setting.value), placeholder: setting.default ?? "",
                             autocomplete: "off", spellcheck: "false", change: changed});
      slider = this.slider(setting, input, changed);
    }
    input.setAttribute("aria-describedby", `${id}-doc`);
    this.fields.set(setting.name, input);
    return make("div", {class: "setting"}, label, input, ...(slider ? [slider] : []), help);
  }

  // A slider beside a number, logarithmic, or null. It follows what is typed.
  slider(setting, input, changed) {
    const first = numberOf(setting.value), half = SLIDER_STEPS / 2;
    if (!first) return null;
    const slider = make("input", {type: "range", min: -half, max: half, step: 1, value: 0, "aria-label": `${setting.name}, slider`,
      input: () => {
        input.value = first.write(first.value * 2 ** (slider.value / half * 5));
        slider.setAttribute("aria-valuetext", input.value);
        changed();
      }});
    input.addEventListener("change", () => {
      const typed = numberOf(input.value);
      if (typed && typed.multiple === first.multiple) slider.value = String(Math.log2(typed.value / first.value) * half / 5);
    });
    return slider;
  }

  change(name, value) {
    this.changed.set(name, value.trim());
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.render(), RENDER_AFTER);
  }

  async render() {
    this.waiting = null;
    const problem = byId("settings-problem"), chosen = Object.fromEntries(this.changed);
    this.onRender();
    try {
      await request("render", {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(chosen)});
      problem.textContent = "";
    } catch (error) {
      problem.textContent = error.message;
    }
    for (const [name, field] of this.fields) field.setAttribute("aria-invalid", String(problem.textContent.includes(`--${name}:`)));
  }

  // What the program has now: a setting may follow from another one.
  update(settings) {
    for (const {name, value, choices} of settings) {
      const field = this.fields.get(name);
      if (!field || field === document.activeElement || this.waiting) continue;
      if (!choices.length) field.value = shortened(value);
      else if ([...field.options].some(option => option.value === value)) field.value = value;
    }
  }

  // The picture shows the values of the fields from now on.
  begin() { this.shown = new Map([...this.fields].map(([name, field]) => [name, field.value])); }

  // What the picture shows, in words: the settings that have been changed.
  text() { return [...this.changed.keys()].map(name => `${name} ${this.shown.get(name) || "default"}`).join(", "); }
}
