// What stands round viser's page: menus and tools above it, the state below it, and at its left the tree of the world over the list of
// properties. viser fills these with two groups of tabs; the lower one shows a tab when it is asked for. A tool or an entry of a menu presses
// viser's control of that label, so that there is one way to do each thing; the state is what the panel shows.
(() => {
  // viser puts its controls into a dock that moves, or on a narrow page into a plain sheet: that one is laid out by frame.css, at any width.
  const asked = window.matchMedia.bind(window);
  window.matchMedia = query => asked(query.startsWith("(max-width:") ? "all" : query);

  const ICONS = {
    play: "M7 4l13 8-13 8z", pause: "M8 5v14M16 5v14", step: "M5 5l9 7-9 7zM18 5v14", reset: "M4 12a8 8 0 1 0 3-6.2M4 4v5h5",
    timeline: "M12 7v5l4 2M4 12a8 8 0 1 0 3-6.2M4 4v4h4", move: "M12 3v18M3 12h18M12 3l-3 3M12 3l3 3M12 21l-3-3M12 21l3-3M3 12l3-3M3 12l3 3M21 12l-3-3M21 12l-3 3",
    scale: "M4 14v6h6M20 10V4h-6M4 20l7-7M20 4l-7 7", undo: "M9 7L4 12l5 5M4 12h10a6 6 0 0 1 6 6", redo: "M15 7l5 5-5 5M20 12H10a6 6 0 0 0-6 6",
    copy: "M9 9h11v11H9zM5 15H4V4h11v1", remove: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13",
    look: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
    all: "M3 12l9-8 9 8M6 10v10h12V10", front: "M4 5h16v14H4zM9 12h6", left: "M4 5h16v14H4zM8 8v8", top: "M4 5h16v14H4zM8 8h8",
    corner: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9", record: "M12 5a7 7 0 1 0 0 14 7 7 0 0 0 0-14zM12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
    select: "M6 3l12 9-6 1.2 3.4 6.3-2.4 1.3-3.4-6.4L6 18z", box: "M4 8l8-4 8 4v8l-8 4-8-4zM4 8l8 4 8-4M12 12v8",
    sphere: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16zM4 12c3 3 13 3 16 0", cylinder: "M6 6c0-3 12-3 12 0v12c0 3-12 3-12 0zM6 6c0 3 12 3 12 0",
    point: "M9 17h6M10 20h4M12 3a6 6 0 0 0-3.5 10.8c.5.5.5 1.2.5 2.2h6c0-1 0-1.7.5-2.2A6 6 0 0 0 12 3z",
    spot: "M9 4h6v4H9zM9 8l-4 8M15 8l4 8M8 18v2M12 17v4M16 18v2",
    sun: "M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v3M12 19v3M2 12h3M19 12h3M5 5l2 2M17 17l2 2M5 19l2-2M17 7l2-2",
    picture: "M4 7h4l2-3h4l2 3h4v12H4zM12 10a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7z",
  };
  const all = (selector, within = document) => [...within.querySelectorAll(selector)];
  const labelled = (elements, label) => elements.find(e => e.textContent.trim() === label);
  const groups = () => all("#root .mantine-Tabs-root");  // the upper and the lower one
  const tabs = (group = document) => all("#root [role=tab]", group);
  const tab = label => labelled(tabs(), label)?.click();
  const opened = group => all("[role=tab][aria-selected=true]", group)[0]?.textContent.trim();
  // Where a control is: in the tab of that title, or among the commands, which are not seen.
  const home = title => title ? document.getElementById(labelled(tabs(), title)?.getAttribute("aria-controls")) : document.querySelector("#root");
  const box = (label, title) => {
    const found = labelled(all("label", home(title) ?? document), label);
    return found && (document.getElementById(found.htmlFor) ?? found.parentElement.parentElement.querySelector("input[type=checkbox]"));
  };
  // An editor that is open is what Undo, Box and the like are for.
  const EDITORS = ["Building", "Model"];
  const button = (label, title) => labelled(all("button:not([role=tab])", home(title) ?? document), label);
  const press = async (label, title) => {
    const editor = opened(groups()[1]);
    const found = () => EDITORS.includes(editor) && button(label, editor) || button(label, title) || box(label, title);
    for (let tries = 0; tries < 60 && !found(); tries++)  // a tab that nobody has opened is filled a little later
      await new Promise(done => setTimeout(done, 50));
    found()?.click();
  };
  const shown = id => document.getElementById(id)?.textContent ?? "";
  let wished = false, until = 0;  // what was pressed counts until the simulator has said so
  const paused = () => performance.now() < until ? wished : shown("state") === "paused";
  const playOrPause = () => {
    wished = !paused(), until = performance.now() + 1000;
    press(wished ? "Pause" : "Play");
  };
  const write = (label, text) => {
    const named = labelled(all("#root label"), label);
    let row = named;  // viser ties not every label to its field
    while (row && !row.querySelector("input")) row = row.parentElement;
    const field = row?.querySelector("input");
    if (!field || field.value === text) return;
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(field, text);  // as a hand does it: React listens
    field.dispatchEvent(new Event("input", { bubbles: true }));
  };
  const step = () => {
    write("Steps", document.getElementById("steps").value);
    press("Step");
  };
  const hands = ["Move and rotate by hand", "Resize by hand"];
  const hand = label => { for (const one of hands) if (Boolean(box(one)?.checked) !== (one === label && !box(one)?.checked)) press(one); };

  const PLAY = { icon: () => paused() ? "play" : "pause", name: () => paused() ? "Play" : "Pause", key: "space", do: playOrPause };
  const STEP = { icon: "step", name: "Step", do: step };
  const UNDO = { icon: "undo", name: "Undo", key: "Ctrl+Z" }, REDO = { icon: "redo", name: "Redo", key: "Ctrl+Y" };
  const COPY = { icon: "copy", name: "Copy", more: "what is picked" };
  const DELETE = { icon: "remove", name: "Delete", more: "what is picked", key: "Delete" };
  const LOOK = { icon: "look", name: "Look at", more: "what is picked", key: "F" };
  const VIEWS = [{ icon: "all", name: "Show all" }, ...["Front", "Left", "Top", "Corner"].map(name =>
    ({ icon: name.toLowerCase(), name, more: "view" }))].map(tool => ({ ...tool, home: "Scene" }));
  const PICTURE = { icon: "picture", name: "Screenshot", home: "Record" };
  const TOOLS = [
    { icon: "select", name: "Select", key: "Esc", do: () => hand(""), on: () => !hands.some(one => box(one)?.checked) },
    { icon: "move", name: hands[0], key: "T", do: () => hand(hands[0]), on: () => box(hands[0])?.checked },
    { icon: "scale", name: hands[1], key: "S", do: () => hand(hands[1]), on: () => box(hands[1])?.checked },
    null, UNDO, REDO, null,
    ...["Box", "Sphere", "Cylinder"].map(name => ({ icon: name.toLowerCase(), name, more: "to put into the world" })),
    null,
    ...["Point", "Spot", "Sun"].map(name => ({ icon: name.toLowerCase(), name, more: "light to put into the world" })),
    null, COPY, DELETE, null, LOOK, ...VIEWS, null, PICTURE,
    { icon: "record", name: "Record", do: () => tab("Record") },
    { icon: "timeline", name: "Go back in time", do: () => tab("Timeline") },
  ];
  const check = name => ({ name, on: () => box(name)?.checked });
  // A box of a list that may not be shown: React draws it when the page is idle, so that what it shows may be old, and a click on it, too.
  const wishes = new Map();  // they count until the simulator has heard them; viser sends the last text only, so all go together
  const me = Math.random().toString(36).slice(2);  // other pages ask, too
  let number = 0;
  const told = name => shown("switches").split("\n").includes(name);
  const fresh = () => [...wishes].filter(([, { until }]) => performance.now() < until);
  const isOn = name => Object.fromEntries(fresh())[name]?.on ?? told(name);
  const switchable = name => ({ name, on: () => isOn(name), do: () => {
    wishes.set(name, { on: !isOn(name), number: ++number, until: performance.now() + 5000 });
    write("Switch", JSON.stringify([`${me} ${number}`, Object.fromEntries(fresh().map(([label, { on }]) => [label, on]))]));
  } });
  const SEEN = ["Grid", "Transparent", "Wireframe", "Shadows", null, "Collisions", "Centres of mass", "Inertias", "Joints", "Link frames", "Labels", "Contacts"];
  const panel = () => !document.documentElement.classList.contains("alone");
  const MENUS = {
    File: () => [{ name: "Save world", home: "Record" }, PICTURE, { name: "Record a replay or a film", do: () => tab("Record") }],
    Edit: () => [UNDO, REDO, null, COPY, DELETE, null, { name: "Reset time", press: "Time" }, { name: "Reset model poses", press: "Models" },
      { name: "Reset world", press: "All" }, null, { name: "Building editor", do: () => tab("Building") },
      { name: "Model editor", do: () => tab("Model") }, null, check("Hold the controls")],
    Camera: () => [LOOK, switchable("Follow what is picked"), null, ...VIEWS],
    View: () => [...SEEN.map(name => name && switchable(name)), null,
      { name: "Panel at the left", on: panel, do: () => document.documentElement.classList.toggle("alone") }],
    Window: () => tabs(groups()[1]).map(e => e.textContent.trim()).map(name => ({ name, do: () => tab(name) }))
      .concat(shown("links").split("\n").filter(Boolean).map(name => ({ name, do: () => window.open("/link/" + encodeURIComponent(name)) }))),
  };
  const value = what => typeof what === "function" ? what() : what;
  const act = tool => {
    tool.do ? tool.do() : press(tool.press ?? value(tool.name), tool.home);
    setTimeout(show, 100);
  };

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
      button.title = [name, tool.more, tool.key && `(${tool.key})`].filter(Boolean).join(" ");
      button.setAttribute("aria-label", name);
    }
    if (tool.on) button.setAttribute("aria-pressed", String(Boolean(tool.on())));
  };
  const buttons = [];
  const tooled = (bar, tools) => {
    for (const tool of tools) {
      if (!tool) { bar.append(element("span", { class: "apart" })); continue; }
      const button = element("button", { type: "button", class: "tool" });
      button.addEventListener("click", event => {
        act(tool);
        if (event.detail) button.blur();  // by the mouse: the next key is the scene's
      });
      draw(button, tool);
      buttons.push([button, tool]);
      bar.append(button);
    }
    return bar;
  };

  // An entry is made when its menu opens: which tabs there are, and what is on, is asked then.
  const entry = tool => {
    if (!tool) return element("hr");
    const button = element("button", { type: "button", role: tool.on ? "menuitemcheckbox" : "menuitem", tabindex: "-1" },
      element("span", {}, value(tool.name)), ...(tool.key ? [element("kbd", {}, tool.key)] : []));
    if (tool.on) mark(button, tool);
    button.addEventListener("click", () => { close(); act(tool); });
    return button;
  };
  const mark = (button, tool) => button.setAttribute("aria-checked", String(Boolean(tool.on())));
  let entries = [];  // of the menu that opened last, those that are on or off
  const menus = element("nav", { id: "menus", role: "menubar", "aria-label": "Menus" });
  const close = () => { for (const title of menus.children) unfold(title, false); };
  const unfold = (title, on) => {
    title.setAttribute("aria-expanded", String(on));
    lists.get(title).hidden = !on;
    if (!on) return;
    const list = lists.get(title), at = title.getBoundingClientRect();
    const tools = MENUS[title.textContent]();
    list.replaceChildren(...tools.map(entry));
    entries = tools.flatMap((tool, number) => tool?.on ? [[list.children[number], tool]] : []);
    list.style.left = `${Math.max(0, Math.min(at.left, innerWidth - list.offsetWidth))}px`;
  };
  const lists = new Map();
  for (const name of Object.keys(MENUS)) {
    const title = element("button", { type: "button", role: "menuitem", "aria-haspopup": "menu", "aria-expanded": "false" }, name);
    const list = element("div", { class: "menu", role: "menu", "aria-label": name, hidden: "" });
    lists.set(title, list);
    const open = () => title.getAttribute("aria-expanded") === "true";
    const alone = () => { close(); unfold(title, true); };
    title.addEventListener("click", () => open() ? close() : alone());
    title.addEventListener("pointerenter", () => { if (!open() && [...lists.values()].some(other => !other.hidden)) alone(); });
    menus.append(title);
  }
  document.addEventListener("pointerdown", event => { if (!event.target.closest?.("#menus, .menu")) close(); }, true);
  const walk = (event, key) => {  // with the keys, as menus are
    const title = [...menus.children].find(e => e === document.activeElement || lists.get(e).contains(document.activeElement));
    if (!title) return false;
    const inside = all("button", lists.get(title)), at = inside.indexOf(document.activeElement);
    const aside = { arrowright: 1, arrowleft: -1 }[key], down = { arrowdown: 1, arrowup: -1 }[key];
    if (key === "escape") { close(); title.focus(); }
    else if (aside) {
      const titles = [...menus.children], next = titles[(titles.indexOf(title) + aside + titles.length) % titles.length], on = !lists.get(title).hidden;
      close(), next.focus(), unfold(next, on);
    } else if (down && lists.get(title).hidden) { unfold(title, true); all("button", lists.get(title))[0]?.focus(); }
    else if (down) inside[(at + down + inside.length) % inside.length]?.focus();
    else return false;
    event.preventDefault();
    return true;
  };

  const splash = element("div", { id: "splash", role: "status" }, element("b", {}, document.title),
    element("progress", { max: "4", value: "1", "aria-label": "loading" }), element("span", {}, "Unpacking the page"));
  const stage = (number, text) => { splash.children[1].value = number; splash.children[2].textContent = text; };
  const bar = tooled(element("div", { id: "tools", role: "toolbar", "aria-label": "Tools" }), TOOLS);
  const cell = (id, label, more = "") => `<span class="${more}">${label} <b id="${id}"></b></span>`;
  const state = tooled(element("div", { id: "state_bar", role: "region", "aria-label": "State of the simulation" }), [PLAY, STEP]);
  const facts = element("div", { class: "facts" });
  facts.innerHTML = `<span class="wide"><label for="steps">Steps</label> <input id="steps" type="number" min="1" max="1000000" value="1"></span>` +
    `<span><i class="light"></i><b id="bar_run"></b></span>${cell("bar_sim_time", "Sim time")}` +
    `${cell("bar_real_time", "Real time", "wide")}${cell("bar_iterations", "Iterations", "wide")}<span class="widest" id="bar_drawn"></span>`;
  state.append(facts);

  // The edges of the panel: at its right, and between tree and list.
  const edges = ["--left", "--tree"].map((name, number) => {
    const edge = element("div", { class: "edge", "data-edge": name, role: "separator", "aria-orientation": number ? "horizontal" : "vertical" });
    edge.addEventListener("pointerdown", event => {
      edge.setPointerCapture(event.pointerId);
      const place = document.querySelector("#root").getBoundingClientRect();
      edge.onpointermove = ({ clientX, clientY }) => document.documentElement.style.setProperty(name, number
        ? `${Math.max(80, Math.min(clientY - place.top, place.height - 120))}px` : `${Math.max(160, Math.min(clientX, innerWidth - 120))}px`);
    });
    edge.addEventListener("pointerup", () => { edge.onpointermove = null; });
    return edge;
  });

  const put = (id, text) => { const place = document.getElementById(id); if (place && place.textContent !== text) place.textContent = text; };
  let picked = "";
  function show() {
    const now = document.querySelector("#root .tabler-icon-cloud-check") ? shown("state") : "gzclient does not answer";
    state.dataset.run = paused() ? "paused" : now.startsWith("real-time") ? "runs" : "";
    put("bar_run", now);
    for (const name of ["sim_time", "real_time", "iterations"]) put(`bar_${name}`, shown(name));
    put("bar_drawn", document.documentElement.dataset.drawn ?? "");
    const heard = Number(shown("heard").split("\n").map(one => one.split(" ")).find(([who]) => who === me)?.[1] ?? 0);
    for (const [label, { number }] of wishes) if (number <= heard) wishes.delete(label);
    for (const [button, tool] of buttons) draw(button, tool);
    for (const [button, tool] of entries) mark(button, tool);
    const list = opened(groups()[1]), what = shown("picked");
    if (what !== picked && ["Scene", "Physics"].includes(list)) tab("Properties");  // picked in the scene; the others are worked with
    picked = what;
    document.documentElement.dataset.list = list ?? "";
    name();
    for (const notice of document.querySelectorAll(".mantine-Notification-root:not([data-looked])"))  // not seen until then
      if (notice.textContent.includes("Software WebGL")) notice.querySelector("button")?.click();  // the foot says it
      else notice.dataset.looked = "";
  }
  // For who hears the page: a field is named by the label before it, where viser ties none to it.
  function name() {
    const labels = all("#root label");
    for (const field of all("#root input:not([aria-label]):not([type=hidden])")) {
      if (field.labels.length) continue;
      const before = labels.filter(label => label.compareDocumentPosition(field) & Node.DOCUMENT_POSITION_FOLLOWING).pop();
      if (before) field.setAttribute("aria-label", before.textContent.trim());
    }
  }
  // Rows of the tree that are no model: the list of that name comes up. Beside an editor the tree has room for its tabs only.
  addEventListener("click", event => {
    if (tabs(groups()[0]).includes(event.target.closest?.("[role=tab]")) && EDITORS.includes(opened(groups()[1]))) tab("Properties"), show();
    const row = event.target.closest?.("#root .mantine-Tabs-panel button"), tree = home("World");
    if (!row || !tree?.contains(row)) return;
    const apart = !row.closest(".mantine-Paper-root .mantine-Paper-root");
    if (apart) tab(row.textContent.trim());
    else if (opened(groups()[1]) !== "Joints") tab("Properties");
  });

  const typing = e => e.isContentEditable || ["INPUT", "TEXTAREA", "SELECT"].includes(e.tagName);
  addEventListener("keydown", event => {
    const at = event.target, control = event.ctrlKey || event.metaKey, key = event.key.toLowerCase();
    if (typing(at) || event.altKey || event.repeat || walk(event, key)) return;
    const undo = control && key === "z" && !event.shiftKey, redo = control && (key === "y" || key === "z" && event.shiftKey);
    if (undo) press("Undo");
    else if (redo) press("Redo");
    else if (control) return;
    else if (key === " " && at.tagName !== "BUTTON") playOrPause();
    else if (key === "delete") press("Delete");
    else if (key === "f") press("Look at");
    else if (key === "t" || key === "r") hand(hands[0]);
    else if (key === "s") hand(hands[1]);
    else if (key === "escape") hand("");
    else return;
    if (key !== "escape") event.preventDefault();
    setTimeout(show, 100);
  });

  document.documentElement.append(splash);  // before there is a body: unpacking the page takes the time
  document.addEventListener("DOMContentLoaded", () => {
    document.body.append(menus, bar, state, ...edges, ...lists.values(), splash);
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
