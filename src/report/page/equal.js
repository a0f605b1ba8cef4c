// The two fair comparisons: what a given error costs each technique, and how wrong each still is at a given time.
function draw_equal(state) {
    const settings = settings_at(state.material, state.plot_view);
    const error = column_of(state.metric);
    const timed = settings.some((row) => value_of(row, "gpu_ms.median") !== null);
    const cost = column_of(timed ? "gpu_ms.median" : "fetches.mean");
    const techniques = [...new Set(settings.map((row) => row.t))].sort((a, b) => a - b);
    const errors = settings.map((row) => value_of(row, error.id)).filter((v) => v > 0);
    const costs = settings.map((row) => value_of(row, cost.id)).filter((v) => v > 0);
    $("equal-scope").textContent = `${page.materials[state.material].title}, ${view_title(state.material, state.plot_view)}; error is “${error.title}”, cost is “${cost.title}”. `
        + (settings.length > rows_at(state.material, state.plot_view).length ? "Each technique is given its best setting among those that were run." : "Only the default settings were run on this view, so each technique has one chance.");

    const targets = [...round_steps(errors, 4).reverse(), 0];
    equal_table($("equal-error"), techniques, targets.map((v) => (v ? limit(v, error) : "0")), (t, i) =>
        best(settings.filter((row) => row.t === t && value_of(row, error.id) !== null && value_of(row, error.id) <= targets[i]), cost), cost, "not reached");
    const budgets = round_steps(costs, 5);
    equal_table($("equal-time"), techniques, budgets.map((v) => limit(v, cost)), (t, i) =>
        best(settings.filter((row) => row.t === t && value_of(row, cost.id) !== null && value_of(row, cost.id) <= budgets[i]), error), error, "too slow");
}

const best = (rows, column) => rows.filter((row) => value_of(row, column.id) !== null).reduce((a, b) => (a && value_of(a, column.id) <= value_of(b, column.id) ? a : b), null);

// Round numbers spread evenly, as ratios, over the range of the values; smallest first.
function round_steps(values, count) {
    if (!values.length) return [];
    const low = Math.min(...values), high = Math.max(...values);
    const steps = new Set();
    for (let i = 0; i < count; ++i) {
        const v = low * (high / low) ** ((i + 1) / (count + 1));
        const decade = 10 ** Math.floor(Math.log10(v));
        const round = [1, 1.5, 2, 3, 5, 7, 10].reduce((a, b) => (Math.abs(Math.log(v / decade / b)) < Math.abs(Math.log(v / decade / a)) ? b : a));
        if (round * decade >= low) steps.add(+(round * decade).toPrecision(2));
    }
    return [...steps].sort((a, b) => a - b);
}

function equal_table(holder, techniques, titles, pick, column, otherwise) {
    const picked = techniques.map((t) => titles.map((_, i) => pick(t, i)));
    const winners = titles.map((_, i) => Math.min(...picked.map((line) => (line[i] ? value_of(line[i], column.id) : Infinity))));
    holder.replaceChildren(el("table", { class: "plain" },
        el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Technique"), ...titles.map((title) => el("th", { scope: "col", class: "number" }, title)))),
        el("tbody", {}, ...techniques.map((t, line) => el("tr", {}, el("th", { scope: "row" }, page.techniques[t].title), ...picked[line].map((row, i) =>
            row ? el("td", { class: "number" + (value_of(row, column.id) === winners[i] ? " best" : "") }, with_unit(value_of(row, column.id), column), row.s ? el("small", {}, row.s) : "")
                : el("td", { class: "number none" }, otherwise)))))));
}
