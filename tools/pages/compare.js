"use strict";
// The page is built from the JSON above it. `shown` is all of its state.
const data = JSON.parse(document.getElementById("data").textContent);
const STATUS = {
  unreadable: ["? unreadable", "bad"], different: ["✗ different", "bad"], extra: ["+ no golden", "warn"],
  missing: ["− missing", "warn"], "within-limits": ["≈ within limits", "good"], identical: ["= identical", "good"],
};
const VIEWS = [["four", "All four"], ["expected", "Expected"], ["actual", "Actual"], ["difference", "Difference ×16"],
               ["heat", "Heat map"], ["swap", "Swap"], ["slider", "Slider"]];
const CAPTION = {expected: "Expected", actual: "Actual", difference: "Difference ×16", heat: "Heat map"};
const HINT = {
  swap: "Hover, or press x, to see the other one.", slider: "Drag in the picture, or move the slider.",
  four: "Heat map: the largest difference of a pixel's channels, from blue (1) by red (16) to white (255); gray where there is none.",
};
HINT.heat = HINT.four;
const shown = {picture: null, view: "four", zoom: "0", swapped: false, slide: 50, text: "", status: "all", mark: null};
const $ = (id) => document.getElementById(id);

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value !== null) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function passed(picture) { return picture.status === "identical" || picture.status === "within-limits"; }
function sourceOf(picture, kind) { return (picture.images || {})[kind]; }

// --- the list

function matches(picture) {
  const wanted = shown.status === "all" || (shown.status === "failed" ? !passed(picture) : picture.status === shown.status);
  return wanted && picture.name.toLowerCase().includes(shown.text.toLowerCase());
}

function listItem(picture) {
  const [label, tone] = STATUS[picture.status];
  const source = sourceOf(picture, "actual") || sourceOf(picture, "expected");
  const why = picture.metrics && picture.status !== "identical" ? ` · largest ${picture.metrics.largest}` : "";
  return element("li", {}, element("button", {
    type: "button", "data-name": picture.name, "aria-current": String(picture === shown.picture),
    onclick: () => choose(picture),
  }, source ? element("img", {src: source, alt: "", loading: "lazy"}) : element("span", {class: "blank"}),
     element("span", {class: "name"}, picture.name),
     element("span", {class: "why"}, element("span", {class: tone}, label), why)));
}

function drawList() {
  const list = data.pictures.filter(matches);
  $("list").replaceChildren(...list.map(listItem));
  $("none").hidden = list.length > 0;
  for (const button of $("statuses").children)
    button.setAttribute("aria-pressed", String(button.dataset.status === shown.status));
  if (list.length > 0 && !list.includes(shown.picture)) choose(list[0]);
}

function statusButtons() {
  const count = (wanted) => data.pictures.filter(wanted).length;
  const entries = [["all", "all", data.pictures.length], ["failed", "failed", count((p) => !passed(p))]];
  for (const [status, [label]] of Object.entries(STATUS)) entries.push([status, label, count((p) => p.status === status)]);
  return entries.filter(([status, , number]) => number > 0 || status === "all" || status === "failed")
    .map(([status, label, number]) => element("button", {
      type: "button", "data-status": status,
      onclick: () => { shown.status = status; drawList(); },
    }, `${label} ${number}`));
}

// --- the pictures

function markers(picture) {
  if (!shown.mark) return [];
  const [width, height] = sizeOf(picture);
  return [element("span", {class: "marker",
    style: `left:${100 * (shown.mark.x + 0.5) / width}%;top:${100 * (shown.mark.y + 0.5) / height}%`})];
}

function sizeOf(picture) {
  return picture.expected && picture.expected.size ? picture.expected.size : picture.actual.size;
}

function frame(picture, ...layers) {
  const style = shown.zoom === "0" ? null : `width:${shown.zoom * sizeOf(picture)[0]}px`;
  return element("div", {class: "picture", style}, ...layers, ...markers(picture));
}

function figure(picture, kind) {
  return element("figure", {"data-kind": kind}, element("figcaption", {}, CAPTION[kind]),
                 frame(picture, element("img", {src: sourceOf(picture, kind), alt: `${CAPTION[kind]}: ${picture.name}`})));
}

function swapFigure(picture) {
  const side = shown.swapped ? "actual" : "expected";
  const made = figure(picture, side);
  made.dataset.view = "swap";
  const show = (kind) => {
    made.dataset.kind = kind;
    made.querySelector("figcaption").textContent = CAPTION[kind];
    made.querySelector("img").src = sourceOf(picture, kind);
  };
  made.addEventListener("mouseenter", () => show(shown.swapped ? "expected" : "actual"));
  made.addEventListener("mouseleave", () => show(shown.swapped ? "actual" : "expected"));
  return made;
}

function sliderFigure(picture) {
  const over = element("img", {src: sourceOf(picture, "actual"), alt: `Actual: ${picture.name}`,
                               style: `clip-path:inset(0 0 0 ${shown.slide}%)`});
  const made = element("figure", {"data-kind": "slider"}, element("figcaption", {}, "Expected on the left, actual on the right"),
    frame(picture, element("img", {src: sourceOf(picture, "expected"), alt: `Expected: ${picture.name}`}), over,
          element("span", {class: "edge", style: `left:${shown.slide}%`})));
  const drag = (event) => {
    if (event.buttons !== 1 && event.type !== "pointerdown") return;
    const box = made.querySelector(".picture").getBoundingClientRect();
    slideTo(Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width)));
    event.preventDefault();
  };
  made.addEventListener("pointerdown", drag);
  made.addEventListener("pointermove", drag);
  return made;
}

function slideTo(percent) {
  shown.slide = percent;
  $("slide").querySelector("input").value = percent;
  const over = $("stage").querySelector("[data-kind=slider] img + img");
  if (!over) return;
  over.style.clipPath = `inset(0 0 0 ${percent}%)`;
  $("stage").querySelector(".edge").style.left = `${percent}%`;
}

function available(picture, view) {
  const kinds = {four: ["actual", "expected", "difference", "heat"], swap: ["actual", "expected"],
                 slider: ["actual", "expected"]}[view] || [view];
  return kinds.every((kind) => sourceOf(picture, kind)) && (kinds.length === 1 || picture.rule !== "size" || view === "swap");
}

function stageOf(picture, view) {
  if (view === "swap") return [swapFigure(picture)];
  if (view === "slider") return [sliderFigure(picture)];
  if (view === "four") return ["expected", "actual", "difference", "heat"].map((kind) => figure(picture, kind));
  return [figure(picture, view)];
}

// --- the chosen picture

function row(...cells) {
  return element("tr", {}, ...cells.map((cell, column) => cell instanceof Node ? cell : element(column ? "td" : "th", {}, String(cell))));
}

function fill(section, rows) {
  $(section).hidden = rows.length === 0;
  $(section).querySelector("table").replaceChildren(...rows);
}

function numberRows(metrics) {
  const limits = data.limits;
  return [
    row("", "measured", "allowed"),
    row("largest difference", metrics.largest, limits.largest),
    row(`pixels off by more than ${limits.threshold}`, `${(100 * metrics.share).toFixed(3)} % (${metrics.noticeable})`, `${+(100 * limits.share).toFixed(4)} %`),
    row("mean difference", metrics.mean.toFixed(4), limits.mean),
    row("structural similarity (SSIM)", metrics.ssim.toFixed(5), `at least ${limits.ssim}`),
    row("PSNR", metrics.psnr === null ? "infinite" : `${metrics.psnr.toFixed(2)} dB`, ""),
    row("pixels that differ", `${metrics.differing} of ${metrics.pixels}`, ""),
  ];
}

function colorCell(rgb) {
  return element("td", {}, element("span", {class: "swatch", style: `background:rgb(${rgb.join(" ")})`}), rgb.join(" "));
}

function worstRows(metrics) {
  if (metrics.worst.length === 0) return [];
  return [row("pixel", "expected", "actual"), ...metrics.worst.map((pixel) => element("tr", {},
    element("td", {}, element("button", {type: "button", onclick: () => { shown.mark = pixel; drawStage(); }}, `${pixel.x}, ${pixel.y}`)),
    colorCell(pixel.expected), colorCell(pixel.actual)))];
}

function factRows(picture) {
  const expected = picture.expected || {}, actual = picture.actual || {};
  const names = {path: "file", size: "size", scene_hash: "scene", state_hash: "state of the frame", version: "version",
                 renderer: "renderer", gl_renderer: "GL renderer", gl_version: "GL version", quality: "quality", facts_from: "according to", note: "note"};
  const rows = [row("", "expected", "actual")];
  for (const [key, label] of Object.entries(names)) {
    if (!(key in expected) && !(key in actual)) continue;
    const text = (side) => side[key] === undefined ? "unknown" : key === "size" ? side.size.join(" × ") : side[key];
    const comparable = !["path", "facts_from", "note"].includes(key);
    const changed = comparable && text(expected) !== text(actual) && key in expected && key in actual;
    rows.push(row(label, element("td", {}, text(expected)), element("td", {class: changed ? "changed" : null}, text(actual))));
  }
  return rows;
}

function runDetails(picture) {
  return ["expected", "actual"].filter((side) => picture[side] && picture[side].run).map((side) =>
    element("details", {}, element("summary", {}, `run.json of the ${side} picture (${picture[side].run})`),
            element("pre", {}, JSON.stringify(data.runs[picture[side].run], null, 2))));
}

function drawStage() {
  const picture = shown.picture;
  const order = [shown.view, "four", "swap", "actual", "expected"];
  const view = order.find((candidate) => available(picture, candidate));
  for (const button of $("views").children) {
    button.disabled = !available(picture, button.dataset.view);
    button.setAttribute("aria-pressed", String(button.dataset.view === view));
  }
  $("stage").className = (view === "four" ? "four" : "") + (shown.zoom === "0" ? " fit" : "");
  if (view) $("stage").style.setProperty("--ratio", sizeOf(picture)[0] / sizeOf(picture)[1]);
  $("stage").replaceChildren(...(view ? stageOf(picture, view) : []));
  $("slide").hidden = view !== "slider";
  $("zoom").value = shown.zoom;
  $("hint").textContent = picture.status === "identical" ? "Both are the same, pixel for pixel."
    : view ? HINT[view] || "" : "The report shows the worst pictures; this one is not among them.";
}

function choose(picture) {
  shown.picture = picture;
  shown.mark = null;
  shown.swapped = false;
  const [label, tone] = STATUS[picture.status];
  $("name").textContent = picture.name;
  $("status").textContent = label;
  $("status").className = `badge ${tone}`;
  $("reasons").replaceChildren(...picture.reasons.map((reason) => element("li", {}, reason)));
  $("explanation").textContent = picture.explanation || "";
  showCommand($("approve"), picture.approve);
  fill("numbers", picture.metrics ? numberRows(picture.metrics) : []);
  fill("worst", picture.metrics ? worstRows(picture.metrics) : []);
  fill("facts", factRows(picture));
  $("runs").replaceChildren(...runDetails(picture));
  drawStage();
  for (const button of $("list").querySelectorAll("button")) {
    const current = button.dataset.name === picture.name;
    button.setAttribute("aria-current", String(current));
    if (current) button.scrollIntoView({block: "nearest"});
  }
  history.replaceState(null, "", "#" + encodeURIComponent(picture.name));
}

// --- commands to copy

function showCommand(box, line) {
  box.hidden = !line;
  box.querySelector("code").textContent = line || "";
  box.querySelector("code").title = line || "";
}

async function copy(box) {
  const code = box.querySelector("code"), button = box.querySelector("button");
  getSelection().selectAllChildren(code);
  let done = false;
  try {
    await navigator.clipboard.writeText(code.textContent);
    done = true;
  } catch {
    done = document.execCommand("copy");
  }
  button.textContent = done ? "Copied" : "Selected: press Ctrl+C";
  setTimeout(() => { button.textContent = "Copy"; }, 2000);
}

// --- keys

function move(by) {
  const list = data.pictures.filter(matches);
  const next = list[Math.min(list.length - 1, Math.max(0, list.indexOf(shown.picture) + by))];
  if (next) choose(next);
}

function pressed(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const target = event.target;
  if (target.id === "filter") {
    if (event.key === "Escape" || event.key === "Enter") target.blur();
    return;
  }
  const field = ["INPUT", "SELECT"].includes(target.tagName);
  const actions = {
    j: () => move(1), k: () => move(-1), x: () => { shown.view = "swap"; shown.swapped = !shown.swapped; drawStage(); },
    z: () => { shown.zoom = {"0": "1", "1": "2", "2": "4", "4": "0"}[shown.zoom]; drawStage(); },
    "/": () => $("filter").focus(), c: () => { if (!$("approve").hidden) copy($("approve")); },
  };
  if (!field) Object.assign(actions, {ArrowDown: () => move(1), ArrowUp: () => move(-1)});
  VIEWS.forEach(([view], index) => {
    actions[String(index + 1)] = () => { if (available(shown.picture, view)) { shown.view = view; drawStage(); } };
  });
  if (!actions[event.key]) return;
  event.preventDefault();
  actions[event.key]();
}

// --- once

function start() {
  const counts = data.counts;
  $("verdict").textContent = counts.failed === 0 ? `All ${counts.pictures} pictures are as expected`
    : `${counts.failed} of ${counts.pictures} pictures are not as expected`;
  $("verdict").className = counts.failed === 0 ? "good" : "bad";
  document.title = $("verdict").textContent;
  $("sides").replaceChildren("actual ", element("code", {}, data.actual), " against expected ", element("code", {}, data.expected),
                             ` · globular ${data.version}`);
  const limits = data.limits;
  for (const [name, value] of [["profile", data.profile], ["largest", limits.largest],
                               [`share above ${limits.threshold}`, `${+(100 * limits.share).toFixed(4)} %`], ["mean", limits.mean], ["SSIM", `≥ ${limits.ssim}`]])
    $("limits").append(element("div", {}, element("dt", {}, name), element("dd", {}, String(value))));
  showCommand($("approve-all"), data.approve);
  for (const box of [$("approve-all"), $("approve")]) box.querySelector("button").addEventListener("click", () => copy(box));
  $("statuses").append(...statusButtons());
  $("views").append(...VIEWS.map(([view, label], index) => element("button", {
    type: "button", "data-view": view, title: `key ${index + 1}`, onclick: () => { shown.view = view; drawStage(); },
  }, label)));
  $("filter").addEventListener("input", (event) => { shown.text = event.target.value; drawList(); });
  $("zoom").addEventListener("change", (event) => { shown.zoom = event.target.value; drawStage(); });
  $("slide").querySelector("input").addEventListener("input", (event) => slideTo(Number(event.target.value)));
  document.addEventListener("keydown", pressed);
  const wanted = decodeURIComponent(location.hash.slice(1));
  shown.picture = data.pictures.find((picture) => picture.name === wanted) || data.pictures[0];
  drawList();
  choose(shown.picture);
}

start();
