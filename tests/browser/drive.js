// browser_test.cpp puts this into a copy of the report. It uses the page as a reader does and leaves what it found as JSON.
const problems = [];
addEventListener("error", (event) => problems.push(event.message));
addEventListener("unhandledrejection", (event) => problems.push(String(event.reason)));
addEventListener("securitypolicyviolation", (event) => problems.push(`${event.violatedDirective}: ${event.blockedURI}`));

addEventListener("load", async () => {
  const $ = (selector) => document.querySelector(selector);
  const all = (selector) => [...document.querySelectorAll(selector)];
  const key = (name) => document.body.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true}));
  const names = () => all("#list .name").map((name) => name.textContent);
  const kinds = () => all("#stage figure").map((figure) => figure.dataset.kind);
  // The browser runs on virtual time, which waits for loads and timers but not for decoders or the clipboard.
  const decoded = async () => (await Promise.all(all("#stage img").map(async (img) => {
    if (!img.complete) await new Promise((resolve) => { img.onload = img.onerror = resolve; });
    return img.naturalWidth;
  }))).join();
  let clipboard = "";
  const writeText = async (text) => { clipboard = text; };
  Object.defineProperty(navigator, "clipboard", {value: {writeText}});
  const seen = {title: document.title, protocol: location.protocol, names: names(), first: $("#name").textContent};

  // Records what each picture shows, one after the other.
  seen.kinds = {};
  for (const name of seen.names) {
    if ($("#name").textContent !== name) seen.kinds[name] = "not shown";
    else seen.kinds[name] = kinds().join(" ") + ": " + await decoded();
    key("ArrowDown");
  }
  all("#list button").find((button) => button.dataset.name === "frame-00002.png").click();
  seen.four = kinds();
  seen.fourDecoded = await decoded();
  seen.reasons = all("#reasons li").map((item) => item.textContent);
  seen.explanation = $("#explanation").textContent;
  seen.facts = $("#facts").textContent;
  seen.runs = $("#runs").textContent;
  seen.approve = $("#approve code").textContent;

  key("6");
  seen.swapAtFirst = kinds();
  $("#stage figure").dispatchEvent(new MouseEvent("mouseenter"));
  seen.swapHovered = kinds();
  $("#stage figure").dispatchEvent(new MouseEvent("mouseleave"));
  seen.swapLeft = kinds();
  key("x");
  seen.swapByKey = kinds();
  seen.swapDecoded = await decoded();

  key("7");
  const slider = $("#slide input");
  slider.value = 25;
  slider.dispatchEvent(new Event("input"));
  seen.slider = getComputedStyle($("#stage img + img")).clipPath;
  seen.edge = $("#stage .edge").style.left;

  key("1");
  $("#worst button").click();
  seen.markers = all(".marker").length;
  $("#approve button").click();
  seen.selected = getSelection().toString();
  await new Promise((resolve) => setTimeout(resolve, 10));
  seen.clipboard = clipboard;
  seen.copied = $("#approve button").textContent;

  key("ArrowDown");
  seen.second = $("#name").textContent;
  key("k");
  seen.back = $("#name").textContent;
  $("[data-status=failed]").click();
  seen.failed = names();
  $("[data-status=all]").click();
  $("#filter").value = "DEEPER";
  $("#filter").dispatchEvent(new Event("input"));
  seen.filtered = names();
  seen.filteredChoice = $("#name").textContent;
  $("#filter").value = "";
  $("#filter").dispatchEvent(new Event("input"));

  // Everything that can be clicked must take the focus, and nothing may have been fetched.
  seen.unreachable = all("button:not(:disabled), select, input").filter((control) => {
    if (control.closest("[hidden]") || control.offsetParent === null) return false;
    control.focus();
    return document.activeElement !== control;
  }).length;
  seen.fetched = performance.getEntriesByType("resource").map((entry) => entry.name).filter((name) => !name.startsWith("file:"));
  seen.problems = problems;
  const outcome = document.createElement("pre");
  outcome.id = "outcome";
  // Only ASCII, without the characters that the DOM escapes as text.
  outcome.textContent = JSON.stringify(seen).replace(/[<>&\u0080-\uffff]/g, (c) => "\\u" + c.charCodeAt(0).toString(16).padStart(4, "0"));
  document.body.append(outcome);
});
