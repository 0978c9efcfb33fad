// What stands round viser's page. A tool presses the control of the panel that has that label, so that there is one way to do each thing;
// the state is what the panel shows.
(() => {
  const ICONS = {
    play: "M7 4l13 8-13 8z", pause: "M8 5v14M16 5v14", step: "M5 5l9 7-9 7zM18 5v14", reset: "M4 12a8 8 0 1 0 3-6.2M4 4v5h5",
    timeline: "M12 7v5l4 2M4 12a8 8 0 1 0 3-6.2M4 4v4h4", move: "M12 3v18M3 12h18M12 3l-3 3M12 3l3 3M12 21l-3-3M12 21l3-3M3 12l3-3M3 12l3 3M21 12l-3-3M21 12l-3 3",
    scale: "M4 14v6h6M20 10V4h-6M4 20l7-7M20 4l-7 7", undo: "M9 7L4 12l5 5M4 12h10a6 6 0 0 1 6 6", redo: "M15 7l5 5-5 5M20 12H10a6 6 0 0 0-6 6",
    insert: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM12 9v7M8.5 12.5h7", copy: "M9 9h11v11H9zM5 15H4V4h11v1", remove: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13",
    look: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
    all: "M3 12l9-8 9 8M6 10v10h12V10", front: "M4 5h16v14H4zM9 12h6", left: "M4 5h16v14H4zM8 8v8", top: "M4 5h16v14H4zM8 8h8",
    corner: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9", record: "M12 5a7 7 0 1 0 0 14 7 7 0 0 0 0-14zM12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
    picture: "M4 7h4l2-3h4l2 3h4v12H4zM12 10a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7z",
  };
  const controls = () => document.querySelector("#root") ?? document;
  const labelled = (kind, label) => [...controls().querySelectorAll(kind)].find(e => e.textContent.trim() === label);
  const control = label => labelled("button:not([role=tab])", label) ?? box(label);
  const selected = () => document.querySelector("#root [role=tab][aria-selected=true]")?.textContent.trim();
  // What a tab holds is made when it is opened: then it is opened, and the one that was open comes back.
  const press = async (label, home) => {
    const before = selected();
    if (!control(label) && home) {
      tab(home);
      for (let tries = 0; tries < 60 && !control(label); tries++) await new Promise(done => setTimeout(done, 50));
    }
    control(label)?.click();
    if (before && before !== selected()) setTimeout(() => tab(before), 100);
  };
  const tab = label => {  // it can be dragged, and so listens to the pointer rather than to a click
    const found = labelled("[role=tab]", label);
    for (const kind of ["pointerdown", "mousedown", "pointerup", "mouseup", "click"])
      found?.dispatchEvent(new (kind.startsWith("pointer") ? PointerEvent : MouseEvent)(kind, { bubbles: true, cancelable: true, button: 0, isPrimary: true }));
  };
  const box = label => {
    const found = labelled("label", label);
    return found && (document.getElementById(found.htmlFor) ?? found.parentElement.parentElement.querySelector("input[type=checkbox]"));
  };
  const shown = id => document.getElementById(id)?.textContent ?? "";
  let wished = false, until = 0;  // what was pressed counts until the simulator has said so
  const paused = () => performance.now() < until ? wished : shown("state") === "paused";
  const playOrPause = () => {
    wished = !paused(), until = performance.now() + 1000;
    press(wished ? "Pause" : "Play");
  };
  const TOOLS = [
    { icon: () => paused() ? "play" : "pause", name: () => paused() ? "Play" : "Pause", key: "space", do: playOrPause },
    { icon: "step", name: "Step", do: () => press("Step") },
    { icon: "reset", name: "Reset time and models", do: () => press("All") },
    { icon: "timeline", name: "Go back in time", do: () => tab("Timeline") },
    null,
    { icon: "move", name: "Move and rotate by hand", box: "Move and rotate by hand" },
    { icon: "scale", name: "Resize by hand", box: "Resize by hand" },
    { icon: "undo", name: "Undo", key: "Ctrl+Z", do: () => press("Undo", "World") },
    { icon: "redo", name: "Redo", key: "Ctrl+Y", do: () => press("Redo", "World") },
    { icon: "copy", name: "Copy what is picked", do: () => press("Copy", "World") },
    { icon: "remove", name: "Delete what is picked", key: "Delete", do: () => press("Delete", "World") },
    null,
    { icon: "insert", name: "Insert a model or a shape", do: () => tab("Insert") },
    { icon: "record", name: "Record", do: () => tab("Record") },
    null,
    { icon: "look", name: "Look at what is picked", key: "F", do: () => press("Look at", "World") },
    { icon: "all", name: "Show all", do: () => press("Show all", "View") },
    { icon: "front", name: "Look from the front", do: () => press("Front", "View") },
    { icon: "left", name: "Look from the left", do: () => press("Left", "View") },
    { icon: "top", name: "Look from the top", do: () => press("Top", "View") },
    { icon: "corner", name: "Look from a corner", do: () => press("Corner", "View") },
  ];
  const value = what => typeof what === "function" ? what() : what;

  const element = (kind, attributes = {}, ...inside) => {
    const made = document.createElement(kind);
    for (const [name, text] of Object.entries(attributes)) made.setAttribute(name, text);
    made.append(...inside);
    return made;
  };
  const draw = (button, tool) => {
    const name = value(tool.name), icon = value(tool.icon);
    if (button.dataset.icon !== icon) {
      button.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[icon]}"/></svg>`;
      button.dataset.icon = icon;
      button.title = tool.key ? `${name} (${tool.key})` : name;
      button.setAttribute("aria-label", name);
    }
    const found = tool.box && box(tool.box);
    if (tool.box && (found || !button.hasAttribute("aria-pressed"))) button.setAttribute("aria-pressed", String(Boolean(found?.checked)));
  };

  const splash = element("div", { id: "splash", role: "status" }, element("b", {}, document.title),
    element("progress", { max: "4", value: "1", "aria-label": "loading" }), element("span", {}, "Unpacking the page"));
  const stage = (number, text) => { splash.children[1].value = number; splash.children[2].textContent = text; };
  const buttons = [];
  const bar = element("div", { id: "tools", role: "toolbar", "aria-label": "Tools" });
  for (const tool of TOOLS) {
    if (!tool) { bar.append(element("span", { class: "apart" })); continue; }
    const button = element("button", { type: "button" });
    button.addEventListener("click", event => {
      tool.box ? press(tool.box, "World") : tool.do();
      if (event.detail) button.blur();  // by the mouse: the next key is the scene's
      setTimeout(show, 100);
    });
    draw(button, tool);
    buttons.push([button, tool]);
    bar.append(button);
  }
  const cell = (id, label, more = "") => `<span class="${more}">${label} <b id="${id}"></b></span>`;
  const state = element("div", { id: "state_bar", role: "region", "aria-label": "State of the simulation" });
  state.innerHTML = `<span><i class="light"></i><b id="bar_run"></b></span>${cell("bar_sim_time", "Sim time")}` +
    `${cell("bar_real_time", "Real time", "wide")}${cell("bar_iterations", "Iterations", "wide")}<span class="wide" id="bar_drawn"></span>`;

  const put = (id, text) => { const place = document.getElementById(id); if (place && place.textContent !== text) place.textContent = text; };
  function show() {
    const now = shown("state");
    state.dataset.run = paused() ? "paused" : now.startsWith("real-time") ? "runs" : "";
    put("bar_run", now);
    for (const name of ["sim_time", "real_time", "iterations"]) put(`bar_${name}`, shown(name));
    put("bar_drawn", document.documentElement.dataset.drawn ?? "");
    for (const [button, tool] of buttons) draw(button, tool);
    tree()?.classList.add("tree");
    name();
    for (const notice of document.querySelectorAll(".mantine-Notification-root"))  // the foot says it
      if (notice.textContent.includes("Software WebGL")) notice.querySelector("button")?.click();
  }
  // For who hears the page: a field is named by the label before it, where viser ties none to it.
  function name() {
    const labels = [...document.querySelectorAll("#root label")];
    for (const field of document.querySelectorAll("#root input:not([aria-label]):not([type=hidden])")) {
      if (field.labels.length) continue;
      const before = labels.filter(label => label.compareDocumentPosition(field) & Node.DOCUMENT_POSITION_FOLLOWING).pop();
      if (before) field.setAttribute("aria-label", before.textContent.trim());
    }
  }
  const tree = () => [...document.querySelectorAll(".mantine-Paper-root")].find(e => e.firstElementChild?.textContent.trim() === "Models and lights");

  const typing = e => e.isContentEditable || ["INPUT", "TEXTAREA", "SELECT"].includes(e.tagName);
  addEventListener("keydown", event => {
    const at = event.target, control = event.ctrlKey || event.metaKey, key = event.key.toLowerCase();
    if (typing(at) || event.altKey || event.repeat) return;
    const undo = control && key === "z" && !event.shiftKey, redo = control && (key === "y" || key === "z" && event.shiftKey);
    if (undo) press("Undo", "World");
    else if (redo) press("Redo", "World");
    else if (control) return;
    else if (key === " " && at.tagName !== "BUTTON") playOrPause();
    else if (key === "delete") press("Delete", "World");
    else if (key === "f") press("Look at", "World");
    else return;
    event.preventDefault();
    setTimeout(show, 100);
  });

  document.documentElement.append(splash);  // before there is a body: unpacking the page takes the time
  document.addEventListener("DOMContentLoaded", () => {
    document.body.append(bar, state, splash);
    const begun = performance.now();
    const look = setInterval(() => {
      if (document.querySelector("[role=tab]") && shown("state")) {
        if (shown("state") === "waiting for the simulator" && performance.now() - begun < 3e4) return stage(4, "Waiting for the simulator");
        clearInterval(look);
        splash.remove();
        show();
        setInterval(show, 200);
      } else if (document.querySelector("#root")?.children.length) stage(3, "Asking what is in the world");
      else stage(2, "Starting the page");
    }, 50);
  });
})();
