// Error against cost, drawn as SVG: one mark per setting, the Pareto front, exact techniques on the line at zero.
const error_columns = () => page.columns.filter((c) => c.small && !/^(fetches|gpu_ms|astray_budget)/.test(c.id)
    && page.rows.some((row) => value_of(row, c.id) !== null));

// Hues after Okabe and Ito, told apart by every kind of colour vision; with four shapes they name 28 techniques.
const hues = 7;
const shapes = [
    (r) => `M${-r},0A${r},${r} 0 1 0 ${r},0A${r},${r} 0 1 0 ${-r},0Z`,
    (r) => `M${-r * 0.9},${-r * 0.9}H${r * 0.9}V${r * 0.9}H${-r * 0.9}Z`,
    (r) => `M0,${-r * 1.2}L${r * 1.15},${r * 0.85}H${-r * 1.15}Z`,
    (r) => `M0,${-r * 1.3}L${r * 1.3},0L0,${r * 1.3}L${-r * 1.3},0Z`,
];
const mark_class = (t) => "hue" + (t % hues);
const mark_shape = (t, r) => shapes[t % shapes.length](r);

// A logarithmic axis with a place for zero apart from it, since a logarithm has none and zero is what matters here.
function log_axis(values, from, to, zero_room) {
    const positive = values.filter((v) => v > 0);
    const has_zero = values.some((v) => v === 0);
    let low = positive.length ? Math.min(...positive) : 0.1, high = positive.length ? Math.max(...positive) : 1;
    if (high / low < 4) { low /= 2; high *= 2; }
    low *= 0.85; high *= 1.18;
    const start = from + (has_zero ? zero_room : 0) * Math.sign(to - from);
    const at = (v) => (v <= 0 ? from : start + (to - start) * Math.log(v / low) / Math.log(high / low));
    const decades = Math.log10(high / low);
    const ticks = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
        for (const m of decades < 1.2 ? [1, 1.5, 2, 3, 5, 7] : decades < 3 ? [1, 2, 5] : [1]) {
            const v = m * 10 ** e;
            if (v >= low && v <= high) ticks.push(v);
        }
    return { at, ticks, has_zero };
}

function pareto(points) {
    const front = [];
    let best = Infinity;
    for (const point of [...points].sort((a, b) => a.x - b.x || a.y - b.y)) {
        if (point.y < best) front.push(point), (best = point.y);
    }
    return front;
}

function draw_plots(state, open) {
    const settings = settings_at(state.material, state.plot_view);
    const present = [...new Set(settings.map((row) => row.t))].sort((a, b) => a - b);
    draw_plot($("plot-fetches"), settings, state, "fetches.mean", "Error against fetches", open);
    draw_plot($("plot-time"), settings, state, "gpu_ms.median", "Error against time", open);
    $("plot-key").replaceChildren(...present.map((t) => el("li", { class: mark_class(t), onpointerenter: () => stress(t), onpointerleave: () => stress(null) },
        svg("svg", { viewBox: "-7 -7 14 14", width: 14, height: 14, "aria-hidden": "true" }, svg("path", { d: mark_shape(t, 4.5) })), page.techniques[t].title)));
    function stress(t) {
        for (const group of document.querySelectorAll("#plots svg [data-t]")) group.classList.toggle("dim", t !== null && +group.dataset.t !== t);
    }
}

function draw_plot(figure, settings, state, cost_id, title, open) {
    const error = column_of(state.metric), cost = column_of(cost_id);
    const points = settings.map((row) => ({ row, x: value_of(row, cost_id), y: value_of(row, state.metric) })).filter((p) => p.x !== null && p.y !== null);
    const caption = el("figcaption", {}, el("h3", {}, title));
    if (!points.length) {
        const row = settings[0];
        const missing = row && (value_of(row, cost_id) === null ? cost_id : state.metric);
        figure.replaceChildren(caption, el("p", { class: "no-picture" }, row ? `No marks: ${column_of(missing).title.toLowerCase()}: ${reason_of(row, missing)}.` : "Nothing was run here."));
        return;
    }
    const scale = (v, column) => (column.unit === "share" ? v * 100 : v);
    const size = { w: 560, h: 400, l: 58, r: 16, t: 14, b: 48 };
    const x = log_axis(points.map((p) => p.x), size.l, size.w - size.r, 34);
    const y = log_axis([0, ...points.map((p) => p.y)], size.h - size.b, size.t, 40);
    const drawing = svg("svg", { viewBox: `0 0 ${size.w} ${size.h}`, role: "group", tabindex: 0,
        "aria-label": `${title}: ${points.length} settings. Arrow keys move from mark to mark, Enter opens the picture.` });
    const bottom = size.h - size.b;

    for (const v of x.ticks) drawing.append(svg("line", { class: "grid", x1: x.at(v), x2: x.at(v), y1: size.t, y2: bottom }), svg("text", { class: "tick", x: x.at(v), y: bottom + 18, "text-anchor": "middle" }, tick_text(scale(v, cost))));
    if (x.has_zero) drawing.append(svg("text", { class: "tick", x: x.at(0), y: bottom + 18, "text-anchor": "middle" }, "0"));
    for (const v of y.ticks) drawing.append(svg("line", { class: "grid", x1: size.l, x2: size.w - size.r, y1: y.at(v), y2: y.at(v) }), svg("text", { class: "tick", x: size.l - 8, y: y.at(v) + 4, "text-anchor": "end" }, tick_text(scale(v, error))));
    drawing.append(svg("line", { class: "zero", x1: size.l - 4, x2: size.w - size.r, y1: bottom, y2: bottom }), svg("text", { class: "tick", x: size.l - 8, y: bottom + 4, "text-anchor": "end" }, "0"));
    drawing.append(svg("text", { class: "axis", x: size.w - size.r, y: size.h - 8, "text-anchor": "end" }, cost.title + (unit_of(cost) ? ", " + unit_of(cost) : "") + " →"));
    caption.append(el("p", { class: "note" }, "↑ " + error.title + (unit_of(error) ? ", " + unit_of(error) : "")));

    const front = pareto(points);
    let path = "";
    front.forEach((p, i) => { path += i ? `H${x.at(p.x)}V${y.at(p.y)}` : `M${x.at(p.x)},${size.t}V${y.at(p.y)}`; });
    drawing.append(svg("path", { class: "front", d: path + `H${size.w - size.r}` }));

    const marks = [];
    for (const t of [...new Set(points.map((p) => p.row.t))]) {
        const own = points.filter((p) => p.row.t === t).sort((a, b) => a.x - b.x);
        const group = svg("g", { class: mark_class(t), "data-t": t });
        if (page.techniques[t].exact && own.every((p) => p.y === 0))
            group.append(svg("line", { class: "exact-line", x1: Math.min(...own.map((p) => x.at(p.x))), x2: size.w - size.r, y1: bottom, y2: bottom }));
        group.append(svg("polyline", { class: "thread", points: own.map((p) => x.at(p.x) + "," + y.at(p.y)).join(" ") }));
        for (const p of own) {
            const mark = svg("path", { class: "mark" + (p.row.p ? " default" : ""), d: mark_shape(t, p.row.p ? 6 : 3.6), transform: `translate(${x.at(p.x)},${y.at(p.y)})` });
            mark.lines = [page.techniques[t].title, p.row.s || "no knobs", `${error.title}: ${with_unit(p.y, error)}`, `${cost.title}: ${with_unit(p.x, cost)}`,
                front.includes(p) ? "on the Pareto front" : "", p.row.p ? "" : "opens the picture at the default setting"].filter(Boolean);
            mark.row = p.row;
            mark.append(svg("title", {}, mark.lines.join(", ")));
            mark.addEventListener("pointermove", (event) => show_tip(mark.lines, event.clientX, event.clientY));
            mark.addEventListener("pointerleave", hide_tip);
            mark.addEventListener("click", () => { hide_tip(); open(p.row); });
            group.append(mark);
            marks.push({ mark, x: x.at(p.x) });
        }
        drawing.append(group);
    }
    marks.sort((a, b) => a.x - b.x);
    let current = -1;
    const choose = (index) => {
        marks[current]?.mark.classList.remove("chosen");
        current = index;
        if (current < 0) return hide_tip();
        marks[current].mark.classList.add("chosen");
        drawing.setAttribute("aria-label", marks[current].mark.lines.join(", "));
        const box = marks[current].mark.getBoundingClientRect();
        show_tip(marks[current].mark.lines, box.right, box.bottom);
    };
    drawing.addEventListener("keydown", (event) => {
        if (event.key === "ArrowRight" || event.key === "ArrowLeft") choose((current + (event.key === "ArrowRight" ? 1 : -1) + marks.length) % marks.length);
        else if (event.key === "Enter" && current >= 0) { hide_tip(); open(marks[current].mark.row); }
        else return;
        event.preventDefault();
    });
    drawing.addEventListener("blur", () => choose(-1));
    figure.replaceChildren(caption, drawing);
}

const tick_text = (v) => (v >= 1000 ? Math.round(v).toLocaleString("en") : String(+v.toPrecision(2)));
