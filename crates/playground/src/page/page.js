const at = id => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
const values = {}, starts = {}, rows = {};
let computed = {};
let library, shown = null, timings = [], time;

// ---- the library
async function unpacked() {
  const text = atob(at("library").textContent);
  const bytes = Uint8Array.from(text, character => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}
let compiled, record = null;
async function start() {
  // calibrations, which the page does not offer, import a clock for their optimiser; it is never called
  const imports = {};
  for (const { module, name } of WebAssembly.Module.imports(compiled)) {
    (imports[module] ??= {})[name] = () => { throw new Error(`${name} is missing`); };
  }
  library = (await WebAssembly.instantiate(compiled, imports)).exports;
  if (record !== null) { keep(record); }
}
function write(bytes) {
  const place = library.reserve(bytes.length);
  new Uint8Array(library.memory.buffer, place, bytes.length).set(bytes);
}
function keep(bytes) {
  write(bytes);
  library.keep_record();
}
// Sends a request to the library; returns its answer, or an object of faults by field.
function ask(request) {
  try {
    write(new TextEncoder().encode(JSON.stringify(request)));
    const length = library.answer();
    const bytes = new Uint8Array(library.memory.buffer, library.reply(), length);
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch (error) {
    start();
    return { faults: { wall: `The library stopped (${error.message}). Choose other values.` } };
  }
}

// ---- the fields
function build(described) {
  for (const [title, fields] of GROUPS) {
    const set = make("fieldset", {}, make("legend", { textContent: title }), make("div"));
    const more = make("details", {}, make("summary", { textContent: "More" }));
    for (const field of fields) {
      const about = described.find(one => one.name === field.name);
      field.parameter = about !== undefined;
      starts[field.name] = values[field.name] = field.start ?? about.default;
      (field.more ? more : set).append(row(field, about ?? {}));
    }
    if (fields.some(field => field.more)) { set.append(more); }
    set.append(make("p", { className: "fault", hidden: true, role: "alert" }));
    set.dataset.title = title;
    at("controls").append(set);
  }
}
function row(field, about) {
  // the model description has -1 where this page has an empty field
  const meaning = (about.meaning ?? "").replace("-1: computed", "empty: computed");
  const id = `field_${field.name}`;
  const label = make("label", { textContent: field.label, htmlFor: id, title: meaning });
  const fault = make("p", { className: "fault", hidden: true, role: "alert", id: `fault_${field.name}` });
  const element = make("div", { className: "field" }, label);
  const choices = about.choices?.length ? about.choices.map(choice => choice.name) : null;
  const names = choices ?? (field.names && Object.keys(field.names));
  if (field.file) {
    const input = make("input", { type: "file", id });
    input.addEventListener("change", () => input.files.length && load(input.files[0]));
    element.append(input);
  } else if (field.lines) {
    const area = make("textarea", { id, rows: 12, spellcheck: false });
    area.setAttribute("aria-describedby", fault.id);
    area.addEventListener("input", () => set(field.name, area.value));
    element.classList.add("lines");
    element.append(area);
  } else if (names) {
    const options = names.map(name => make("option", {
      value: name, textContent: field.names?.[name] ?? name.replaceAll("_", " "),
      title: about.choices?.find(choice => choice.name === name)?.meaning ?? "" }));
    const select = make("select", { id, title: meaning }, ...options);
    select.addEventListener("change", () => set(field.name, select.value));
    element.classList.add("choice");
    element.append(select);
  } else {
    const input = make("input", { type: "text", id, inputMode: "decimal", title: meaning });
    input.setAttribute("aria-describedby", fault.id);
    // in Italian a comma is a decimal point; in English it may separate thousands, and is refused
    const decimal = text => isItalian() ? text.replace(/^(-?\d*),(\d+)$/, "$1.$2") : text;
    input.addEventListener("input", () => set(field.name, decimal(input.value)));
    field.computable = about.computable;
    element.append(input, make("small", { textContent: (field.unit ?? about.unit ?? "").replace("2", "²")
      .replace("m3", "m³") }));
    if (field.range) {
      const [min, max, step] = field.range;
      const slider = make("input", { type: "range", min, max, step, id: `slider_${field.name}` });
      slider.setAttribute("aria-label", field.label);
      slider.addEventListener("input", () => set(field.name, slider.value));
      element.append(slider);
    }
  }
  element.append(fault);
  rows[field.name] = element;
  return element;
}
// Shows the values in the fields, and the fields that matter.
function refresh() {
  const parameters = FIELDS.filter(field =>
    field.parameter && values[field.name] !== "" && (field.when?.(values) ?? true));
  const fields = Object.fromEntries(parameters.map(({ name }) => [name, values[name]]));
  const unused = ask({ unused: fields }).answer ?? [];
  for (const field of FIELDS) {
    const element = rows[field.name], value = values[field.name];
    element.hidden = unused.includes(field.name) || !(field.when?.(values) ?? true);
    for (const input of element.querySelectorAll("input:not([type=file]), select, textarea")) {
      const shown = value === "" && input.type === "range" ? computed[field.name] ?? "" : value;
      if (input.value !== shown && !(input === document.activeElement && input.type.startsWith("text"))) {
        input.value = shown;
      }
    }
    if (field.computable) {
      // an empty field shows the number that the library computes
      element.querySelector("input").placeholder = computed[field.name] ?? "";
      element.querySelector("small").textContent = value === "" ? "computed" : "given";
    }
  }
  for (const group of document.querySelectorAll("form details, form fieldset")) {
    group.hidden = ![...group.querySelectorAll(".field")].some(element => !element.hidden);
  }
}
// Fills in the parts of a shape. Measured restitution is that of rectangles.
function fillIn(shape) {
  const source = shape === "rectangle" ? starts.restitution_source : "impulses";
  Object.assign(values, { parts: SHAPES[shape] ?? "", restitution_source: source });
}
function set(name, value) {
  values[name] = value;
  if (name === "shape") { fillIn(value); }
  if (name === "kind" && value === "none") { values.u_start = "0.18"; }
  if (name === "rocking" && value !== "two_sided") {
    // transverse walls turn the wall back by restitution
    Object.assign(values, { damping_model: "none", impact: "restitution", restitution_source: "analytic" });
  }
  if (name === "force_law") {
    // a rigid law has no elastic branch, one with a plateau has its own
    const isRigid = value === "rigid_linear" && values.before_activation === "law";
    if (isRigid || value === "trilinear") { values.before_activation = isRigid ? "rigid" : "law"; }
  }
  refresh();
  schedule();
}
async function load(file) {
  record = new Uint8Array(await file.arrayBuffer());
  keep(record);
  values.record = file.name;
  set("kind", "record");
}

// ---- what is asked and answered
function inputs(width) {
  const parameters = {}, motion = {}, check = {};
  for (const field of FIELDS.filter(field => !rows[field.name].hidden && !field.page)) {
    if (field.computable && values[field.name] === "") { continue; }
    (field.parameter ? parameters : field.check ? check : motion)[field.name] = values[field.name];
  }
  const { lang: language } = document.documentElement;
  return { parameters, motion, check, parts: rectangle(values) ? "" : values.parts, width, language };
}
let waiting = false;
function schedule() {
  if (!waiting) {
    waiting = true;
    requestAnimationFrame(() => { waiting = false; run(); });
  }
}
function run() {
  const begin = performance.now();
  const asked = inputs(at("history").clientWidth), { answer, faults } = ask({ run: asked });
  if (answer) { show({ ...answer, frames: ask("frames").answer }); }
  tell(faults ?? {}, answer?.check?.faults ?? {});
  timings.push(performance.now() - begin);
  current = runOf(answer);
  tellAge();
  remember();
}
// The part of the scene file that a run depends on: all but its check.
const runOf = answer => answer?.toml.split("\n[check]")[0];
// Puts each message beside its field; what has no field goes into the verdict, or into that of the check.
function tell(faults, ofCheck) {
  const left = { ...ofCheck, ...faults };
  for (const [name, element] of Object.entries(rows)) {
    const fault = element.querySelector(".fault"), message = left[name] ?? "";
    delete left[name];
    if (fault.textContent !== message) { fault.textContent = message; }
    fault.hidden = message === "";
    element.classList.toggle("wrong", message !== "");
    if (message !== "") { element.hidden = false; element.closest("details")?.setAttribute("open", ""); }
  }
  const wrong = Object.keys(faults).length > 0;
  document.querySelector(".result").classList.toggle("stale", wrong);
  if (wrong) {
    at("verdict").className = "verdict wrong";
    const isMissing = record === null && faults.record !== undefined;
    at("headline").textContent = isMissing ? "The record is missing" : "This wall cannot be computed";
    const detail = isMissing ? `${faults.record}.` : Object.values(left).join(" ");
    at("detail").textContent = (detail || "See the message beside the field.") +
      (shown === null ? "" : " Below is the last wall that could be computed.");
  }
}
function show(answer) {
  const isSame = runOf(shown) === runOf(answer);
  shown = answer;
  computed = answer.computed;
  refresh();
  at("verdict").className = `verdict ${answer.verdict.state}`;
  at("headline").textContent = answer.verdict.headline;
  at("detail").textContent = answer.verdict.detail;
  at("warnings").replaceChildren(...answer.warnings.map(textContent => make("li", { textContent })));
  at("facts").replaceChildren(...answer.facts.map(pair =>
    make("tr", {}, ...pair.map(textContent => make("td", { textContent })))));
  at("ties").replaceChildren(...answer.captions.map(([id, textContent]) => {
    return make("figure", {}, make("figcaption", { textContent }), make("div", { className: "plot", id }));
  }));
  for (const [id, { svg, area, ranges }] of Object.entries(answer.charts)) {
    const height = `top: ${100 * area[2]}%; height: ${100 * (area[3] - area[2])}%`;
    at(id).innerHTML = svg + (id === "force" ? `<div class="dot"></div>`
      : `<div class="cursor" style="${height}"></div>`);
    Object.assign(at(id).dataset, { area: JSON.stringify(area), ranges: JSON.stringify(ranges) });
    const caption = at(id).closest("figure").querySelector("figcaption").textContent;
    at(id).querySelector("svg").setAttribute("aria-label", caption);
  }
  showCheck(answer.check);
  at("scene").textContent = answer.toml;
  const times = answer.frames.t;
  at("time").max = times.length - 1;
  at("wall").innerHTML = answer.drawing;
  at("shown").textContent = answer.factor === 1 ? "To scale"
    : `Wall to scale, displacement enlarged ${answer.factor}\u00a0times`;
  const instant = answer.summary.falls ?? answer.summary.peak_time;
  const frame = times.findIndex(time => time >= instant);
  pose(!time.isPlaying() && !isSame ? (frame < 0 ? times.length - 1 : frame)
    : Math.min(Number(at("time").value), times.length - 1));
}
// Shows a frame: the wall turns as the history says, and cursors follow.
function pose(frame) {
  const { frames, summary, factor } = shown, wall = { ...shown.wall, ties: frames.ties };
  const u = frames.u[frame], t = frames.t[frame];
  drawTies(wall, frame, turnWall(wall, [at("lower"), at("upper")], factor * u), factor);
  const ratio = u / wall.u_ins[u < 0 ? 1 : 0];
  at("time").value = frame;
  at("time").setAttribute("aria-valuetext", `${t.toFixed(2)} s`);
  const fallen = summary.falls !== null && t >= summary.falls;
  at("now").textContent = `${t.toFixed(2)} s: ` + (fallen && Math.abs(ratio) > 1.05 ? "falling"
    : `${(1000 * u).toFixed(1)} mm, ${ratio.toFixed(2)} u_ins`);
  at("tie_now").textContent = frames.ties.length === 0 ? "" : `tie: ${statesOf(frames.ties, frame)}, ` +
    `${forcesOf(frames.ties, frame)} kN` +
    (frames.ties.some(tie => tie.yields) ? `, longer by ${longerBy(frames.ties, frame)} mm` : "");
  moveCursors(t, [ratio, frames.f[frame]]);
}
function showCheck(check) {
  const isMade = check !== null && check.faults === undefined;
  at("check").hidden = check === null;
  at("check_more").hidden = !isMade;
  at("check").className = `verdict ${!isMade ? "wrong" : check.passed ? "stands" : "falls"}`;
  if (!isMade) {
    at("check_headline").textContent = "The check needs more, or other values";
    at("check_detail").textContent = Object.values(check?.faults ?? {}).join(" ");
    return;
  }
  at("check_headline").textContent = `${check.title}: ${check.headline}`;
  const [detail, ...notes] = check.notes, listed = textContent => make("li", { textContent });
  at("check_detail").textContent = detail;
  at("check_rows").innerHTML = check.rows;
  at("check_numbers").innerHTML = check.numbers;
  at("check_caption").innerHTML = check.caption;
  at("check_notes").replaceChildren(...notes.map(listed));
  at("check_warnings").replaceChildren(...check.warnings.map(listed));
  at("plane").innerHTML = check.svg;
}

// ---- fragility
// The scene file that the fields make, if they make one, and that of the fragility shown.
let round = 0, current, fragilityOf;
// Shows whether the fields have changed since the fragility was computed.
function tellAge() {
  const isStale = current !== fragilityOf;
  at("fragility_result").classList.toggle("stale", isStale);
  at("fragility_stale").hidden = !isStale;
}
function fragility() {
  const mine = ++round, begin = performance.now(), toml = current;
  const end = faults => {
    at("progress").hidden = true;
    at("fragility_fault").textContent = Object.values(faults).join(" ");
    at("fragility_fault").hidden = Object.keys(faults).length === 0;
  };
  const { faults } = ask({ fragility: inputs(0) });
  if (faults) { end(faults); return; }
  at("progress").hidden = false;
  at("progress").value = 0;
  const next = () => {
    if (mine !== round) { return; }
    const { answer, faults } = ask("next_motion");
    if (faults) { end(faults); return; }
    at("progress").value = answer.done;
    if (answer.result === null) { setTimeout(next); return; }
    end({});
    at("states").innerHTML = answer.result.table;
    at("fragility_chart").innerHTML = answer.result.figure;
    at("fragility_result").hidden = false;
    fragilityOf = toml;
    tellAge();
    window.playground.fragility = { milliseconds: performance.now() - begin, ...answer.result };
  };
  setTimeout(next);
}

// ---- files and links
function hash() {
  const changed = FIELDS.filter(({ name }) => !rows[name].hidden && values[name] !== starts[name]);
  const pairs = changed.map(({ name }) => [name, values[name]]);
  return new URLSearchParams(isItalian() ? [...pairs, ["lang", "it"]] : pairs).toString();
}
let remembering = null;
function remember() {
  clearTimeout(remembering);
  remembering = setTimeout(() => history.replaceState(null, "", `#${hash()}`), 250);
}
function recall() {
  Object.assign(values, starts);
  const given = new URLSearchParams(location.hash.slice(1));
  for (const [name, value] of given) {
    if (Object.hasOwn(values, name)) { values[name] = value; }
  }
  if (!rectangle(values) && values.parts === "") { fillIn(values.shape); }
  refresh();
  speak(given.get("lang") === "it" ? "it" : "en");
}
async function copy(text, what) {
  try {
    await navigator.clipboard.writeText(text);
    at("done").textContent = `${what} copied.`;
  } catch {
    at("done").textContent = "The browser does not allow copying; select the text instead.";
  }
}
// Opens the report of the check in a tab of its own; a blocked one is saved instead.
function report(language) {
  const { answer, faults } = ask({ report: language });
  if (faults) { at("done").textContent = Object.values(faults).join(" "); return; }
  const href = URL.createObjectURL(new Blob([answer], { type: "text/html" }));
  if (window.open(href) === null) { make("a", { href, download: "report.html" }).click(); }
}
function save(kind, name, type) {
  const { answer, faults } = ask(kind);
  if (faults) { at("done").textContent = Object.values(faults).join(" "); return; }
  const link = make("a", { href: URL.createObjectURL(new Blob([answer], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function listen() {
  at("controls").addEventListener("submit", event => event.preventDefault());
  time = player(() => shown.frames.t, pose);
  at("language").addEventListener("click", () => speak(isItalian() ? "en" : "it"));
  at("fragility").addEventListener("click", fragility);
  at("copy_scene").addEventListener("click", () => copy(shown?.toml ?? "", "Scene file"));
  for (const language of ["en", "it"]) {
    at(`report_${language}`).addEventListener("click", () => report(language));
  }
  at("copy_link").addEventListener("click", () =>
    copy(`${location.href.split("#")[0]}#${hash()}`, "Link"));
  at("save_csv").addEventListener("click", () => save("csv", "history.csv", "text/csv"));
  at("save_svg").addEventListener("click", () => save("svg", "wall.svg", "image/svg+xml"));
  document.addEventListener("dragover", event => {
    event.preventDefault();
    document.body.classList.add("dropping");
  });
  document.addEventListener("dragleave", () => document.body.classList.remove("dropping"));
  document.addEventListener("drop", event => {
    event.preventDefault();
    document.body.classList.remove("dropping");
    if (event.dataTransfer.files.length) { load(event.dataTransfer.files[0]); }
  });
  window.addEventListener("hashchange", recall);
  let width = innerWidth;
  window.addEventListener("resize", () => {
    if (innerWidth !== width) { width = innerWidth; schedule(); }
  });
}
// for tests
window.playground = { ask, timings, shown: () => shown, load, fragility: null };
unpacked().then(async module => {
  compiled = module;
  await start();
  build(ask("parameters").answer);
  listen();
  recall();
}).catch(error => {
  at("headline").textContent = "This browser cannot run the library";
  at("detail").textContent = `It needs WebAssembly and DecompressionStream: ${error.message}`;
});
