"use strict";
// Draws what the page holds: see the module rotordyn.page.packed for the form of the content.
(async () => {
  const FARTHER = 1.7, LEGEND_LINE = 20;
  const element = (id) => document.getElementById(id);
  const held = async (id) => {
    const letters = atob(element(id).textContent), coded = new Uint8Array(letters.length);
    for (let k = 0; k < letters.length; k += 1) coded[k] = letters.charCodeAt(k);
    const stream = new Blob([coded]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };
  const text = (bytes) => new TextDecoder().decode(bytes);

  const bytes = await held("content");
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const content = JSON.parse(text(bytes.subarray(4, 4 + length)));
  if (!Object.keys(content).length) { document.body.dataset.drawn = "all"; return; }
  const script = document.createElement("script");
  script.textContent = text(await held("library"));
  document.head.append(script);

  const array = (of) => {
    const kind = of.$ === "i" ? Int32Array : Float32Array;
    return new kind(bytes.buffer, 4 + length + of.at, of.n);
  };
  const rows = (flat, shape) => {
    if (shape.length < 2) return flat;
    const width = shape[shape.length - 1];
    return Array.from({ length: flat.length / width }, (_, k) => flat.subarray(k * width, (k + 1) * width));
  };
  let colours = {};
  const look = () => {
    const style = getComputedStyle(document.documentElement);
    for (const name of ["ink", "faint", "paper", "rule"]) colours[`@${name}`] = style.getPropertyValue(`--${name}`).trim();
  };
  // A copy with arrays for their places and colours for their names; "moving" is left for later.
  const revived = (value) => {
    if (typeof value === "string") return colours[value] ?? value;
    if (Array.isArray(value)) return value.map(revived);
    if (value === null || typeof value !== "object") return value;
    if ("$" in value) return rows(array(value), value.w);
    const copy = {};
    for (const [key, each] of Object.entries(value)) if (key !== "moving") copy[key] = revived(each);
    return copy;
  };
  const axisLook = () => ({
    gridcolor: colours["@rule"], zerolinecolor: colours["@rule"], linecolor: colours["@faint"],
    automargin: true, ticks: "outside", tickcolor: colours["@faint"], exponentformat: "none",
  });
  const narrow = matchMedia("screen and (max-width: 34rem)"), printed = matchMedia("print");
  const small = () => narrow.matches || printed.matches;
  const layoutOf = (layout) => {
    const own = revived(layout);
    const scene = { gridcolor: colours["@rule"], color: colours["@ink"], showbackground: false, exponentformat: "none" };
    const base = {
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
      font: { color: colours["@ink"], family: "system-ui, sans-serif", size: small() ? 11 : 13 },
      margin: { l: 60, r: 15, t: 12, b: 50 }, hovermode: "closest", autosize: true, separators: ".\u2009",
      hoverlabel: { bgcolor: colours["@paper"], font: { color: colours["@ink"] } },
      legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0 },
      modebar: { bgcolor: "rgba(0,0,0,0)", color: colours["@faint"], activecolor: colours["@ink"] },
    };
    const result = { ...base, ...own };
    for (const key of Object.keys(result)) {
      if (/^[xy]axis\d*$/.test(key)) result[key] = { ...axisLook(), ...result[key] };
    }
    if (result.scene) {
      for (const key of ["xaxis", "yaxis", "zaxis"]) result.scene[key] = { ...scene, ...result.scene[key] };
      if (small()) result.scene.camera = fartherBack(result.scene.camera);
    }
    return result;
  };
  // What fills a wide frame is cut off by a narrow one.
  const fartherBack = (camera) => {
    const eye = { x: 1.25, y: 1.25, z: 1.25, ...camera?.eye };
    return { ...camera, eye: Object.fromEntries(Object.entries(eye).map(([axis, at]) => [axis, FARTHER * at])) };
  };
  const settings = { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["select2d", "lasso2d", "sendChartToCloud"] };

  const charts = {};
  const chosen = (chart) => chart.inputs.map((each) => Number(each.tagName === "SELECT" ? each.selectedIndex : each.value));
  const place = (chart, by = chart.spec.controls.map((_, axis) => axis)) => {
    const now = chosen(chart);
    return by.reduce((at, axis) => at * chart.spec.controls[axis].options.length + now[axis], 0);
  };
  // What moves has a leading axis for each control, or for those named under "by".
  const slice = (chart, moving) => {
    const by = moving.by ?? chart.spec.controls.map((_, axis) => axis);
    const at = place(chart, by), of = moving.by ? moving.values : moving;
    if (Array.isArray(of)) return of[at];
    const shape = of.w.slice(by.length), size = shape.reduce((a, b) => a * b, 1);
    return rows(array(of).subarray(at * size, (at + 1) * size), shape);
  };
  // Legends do not break names: of what is longer than a chart is wide the end would be lost.
  const inLines = (name, width) => {
    const longest = (width - 60) / (small() ? 6.2 : 7), lines = [""];
    for (const word of name.split(" ")) {
      const last = lines.length - 1, longer = lines[last] ? `${lines[last]} ${word}` : word;
      if (longer.length > longest && lines[last]) lines.push(word); else lines[last] = longer;
    }
    return lines.join("<br>");
  };
  const traces = (chart, width) => chart.spec.traces.map((trace) => {
    const copy = revived(trace);
    if (copy.name) copy.name = inLines(copy.name, width);
    for (const [key, of] of Object.entries(trace.moving ?? {})) copy[key] = slice(chart, of);
    return copy;
  });
  const say = (chart) => {
    const words = chart.spec.words[place(chart)];
    if (words !== undefined) chart.words.textContent = words;
  };
  const axisTitles = (chart) => Object.fromEntries(
    Object.entries(chart.spec.layout.moving ?? {}).map(([key, of]) => [key, slice(chart, of)]));
  const move = (chart) => {
    const changes = {}, which = [];
    chart.spec.traces.forEach((trace, k) => {
      if (!trace.moving) return;
      which.push(k);
      for (const [key, of] of Object.entries(trace.moving)) (changes[key] ??= []).push(slice(chart, of));
    });
    Plotly.update(chart.plot, changes, axisTitles(chart), which);
  };

  // Cross-sections move rigidly: u + θ × arm at an instant of the period.
  const vibrating = (chart, phase) => {
    const { spec } = chart, points = array(spec.points), section = array(spec.place);
    const count = spec.station.n, station = array(spec.station);
    const motion = array(spec.motion).subarray(place(chart) * count * 12, (place(chart) + 1) * count * 12);
    const c = Math.cos(phase), s = Math.sin(phase), u = new Float32Array(count * 6);
    for (let k = 0; k < u.length; k += 1) u[k] = (motion[2 * k] * c - motion[2 * k + 1] * s) || 0;
    const n = section.length, x = new Float32Array(n), y = new Float32Array(n), z = new Float32Array(n);
    for (let k = 0; k < n; k += 1) {
      const at = 6 * section[k];
      const a = points[3 * k] - station[section[k]], b = points[3 * k + 1], d = points[3 * k + 2];
      x[k] = 1e3 * (points[3 * k] + u[at] + u[at + 4] * d - u[at + 5] * b);
      y[k] = 1e3 * (b + u[at + 1] + u[at + 5] * a - u[at + 3] * d);
      z[k] = 1e3 * (d + u[at + 2] + u[at + 3] * b - u[at + 4] * a);
    }
    return { x, y, z };
  };
  const corners = (of) => {
    const flat = array(of), count = flat.length / 3, sides = [0, 1, 2].map(() => new Int32Array(count));
    for (let k = 0; k < flat.length; k += 1) sides[k % 3][(k - k % 3) / 3] = flat[k];
    return { i: sides[0], j: sides[1], k: sides[2] };
  };
  const axes3d = (of) => {
    const flat = array(of), part = (k) => Float32Array.from({ length: flat.length / 3 }, (_, n) => 1e3 * flat[3 * n + k]);
    return { x: part(0), y: part(1), z: part(2) };
  };
  const body = { type: "mesh3d", hoverinfo: "skip", flatshading: false, lighting: { ambient: 0.55, diffuse: 0.7, specular: 0.15, roughness: 0.8 } };
  const shapeTraces = (chart) => [
    { ...body, color: "#4c9a73", ...corners(chart.spec.triangles), ...vibrating(chart, 0) },
    { ...body, color: colours["@faint"], opacity: 0.35, ...corners(chart.spec.still_triangles), ...axes3d(chart.spec.still_points) },
  ];
  const shapeLayout = () => layoutOf({
    showlegend: false, margin: { l: 0, r: 0, t: 0, b: 0 },
    scene: {
      aspectmode: "data", dragmode: "orbit",
      camera: { up: { x: 0, y: 1, z: 0 }, eye: { x: -0.9, y: 0.8, z: 2 } },
      xaxis: { title: { text: "x [mm]" } }, yaxis: { title: { text: "y [mm]" } }, zaxis: { title: { text: "z [mm]" } },
    },
  });
  const animate = (chart) => {
    const button = chart.figure.querySelector(".play");
    let last = 0, phase = 0;
    const step = async (time) => {
      if (!chart.playing) return;
      phase += Math.min(time - last, 100) / 2000 * 2 * Math.PI;
      last = time;
      const at = vibrating(chart, phase);
      await Plotly.restyle(chart.plot, { x: [at.x], y: [at.y], z: [at.z] }, [0]);
      chart.frames = (chart.frames ?? 0) + 1;
      requestAnimationFrame(step);
    };
    button.addEventListener("click", () => {
      chart.playing = !chart.playing;
      button.textContent = chart.playing ? "Pause" : "Play";
      button.setAttribute("aria-pressed", String(chart.playing));
      if (chart.playing) requestAnimationFrame((time) => { last = time; step(time); });
    });
  };

  // A legend scrolls that is higher than half a chart.
  const fitLegend = (chart, drawn) => {
    const names = drawn.filter((trace) => trace.showlegend !== false).map((trace) => trace.name ?? "");
    const lines = names.reduce((sum, name) => sum + name.split("<br>").length, 0);
    chart.plot.style.height = `${Math.max(parseFloat(chart.plot.style.height), 2 * LEGEND_LINE * lines)}px`;
  };

  const draw = async (chart, size = {}) => {
    const shapes = chart.spec.kind === "shapes";
    if (chart.spec.words.length) say(chart);
    const layout = { ...(shapes ? shapeLayout() : layoutOf(chart.spec.layout)), ...size };
    const drawn = shapes ? shapeTraces(chart) : traces(chart, size.width ?? chart.plot.clientWidth);
    if (narrow.matches && layout.showlegend !== false) fitLegend(chart, drawn);
    await Plotly.react(chart.plot, drawn, layout, settings);
    if (!shapes && chart.spec.layout.moving) await Plotly.relayout(chart.plot, axisTitles(chart));
    chart.drawn = true;
  };
  for (const [name, spec] of Object.entries(content)) {
    const figure = element(name);
    const chart = {
      spec, figure, plot: figure.querySelector(".plot"), words: figure.querySelector(".words"),
      inputs: [...figure.querySelectorAll("select, input")],
    };
    charts[name] = chart;
    chart.inputs.forEach((input, k) => input.addEventListener("input", () => {
      const output = figure.querySelector(`output[for="${input.id}"]`);
      if (output) output.textContent = spec.controls[k].options[chosen(chart)[k]];
      if (spec.words.length) say(chart);
      if (!chart.drawn) return;
      if (spec.kind !== "shapes") move(chart);
      else if (!chart.playing) { const at = vibrating(chart, 0); Plotly.restyle(chart.plot, { x: [at.x], y: [at.y], z: [at.z] }, [0]); }
    }));
    if (spec.kind === "shapes") animate(chart);
  }
  look();
  // One by one, so that the page answers meanwhile: nearest to the reader first, but those in
  // space, which take longest, behind the others unless they are in view.
  const all = Object.values(charts);
  const inSpace = (spec) => spec.kind === "shapes" || spec.traces.some((trace) => trace.type === "surface");
  const urgency = (chart) => {
    const { top, bottom } = chart.figure.getBoundingClientRect();
    const away = Math.max(top - innerHeight, -bottom, 0);
    return away > 0 && inSpace(chart.spec) ? away + 1e6 : away;
  };
  const drawAll = async () => {
    const left = new Set(all);
    while (left.size) {
      const next = [...left].reduce((a, b) => (urgency(b) < urgency(a) ? b : a));
      left.delete(next);
      await draw(next);
      document.body.dataset.drawn = left.size ? "some" : "all";
      await new Promise((resolve) => setTimeout(resolve));
    }
  };
  const redraw = () => { look(); all.filter((chart) => chart.drawn).forEach(draw); };
  const dark = matchMedia("(prefers-color-scheme: dark)");
  dark.addEventListener("change", redraw);
  printed.addEventListener("change", (event) => {
    look();
    for (const chart of all) {
      // What is in space would not be drawn in time: its picture shrinks, unless its colours change.
      if (inSpace(chart.spec) && !dark.matches) continue;
      const alone = chart.figure.matches(".wide, :only-child");
      const width = alone ? 680 : 335; // of A4 within its margins
      draw(chart, event.matches ? { width, autosize: false } : {});
    }
  });
  await drawAll();
})();
