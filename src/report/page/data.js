// The results as the page holds them, and the questions the rest of the page asks of them.
const page = JSON.parse(document.getElementById("data").textContent);
const column_index = new Map(page.columns.map((column, i) => [column.id, i]));
const column_of = (id) => page.columns[column_index.get(id)];

const value_of = (row, id) => row.n[column_index.get(id)];
const reason_of = (row, id) => {
    if (id === "wrong") id = value_of(row, "missed_first_hit") === null ? "missed_first_hit" : "early_hit";
    const field = id.split(".")[0];
    return row.r && field in row.r ? page.reasons[row.r[field]] : "not measured";
};
const no_picture_reason = (row) => (row && row.x !== undefined ? page.reasons[row.x] : "this picture was not made");

for (const row of [...page.rows, ...page.sweep]) row.s = page.settings[row.s];

const rows_by_place = new Map();  // "material/view" -> rows in the order of the techniques
for (const row of page.rows) {
    const place = row.m + "/" + row.v;
    if (!rows_by_place.has(place)) rows_by_place.set(place, []);
    rows_by_place.get(place).push(row);
}
for (const rows of rows_by_place.values()) rows.sort((a, b) => a.t - b.t);
const sweep_by_place = new Map();
for (const row of page.sweep) {
    const place = row.m + "/" + row.v;
    if (!sweep_by_place.has(place)) sweep_by_place.set(place, []);
    sweep_by_place.get(place).push(row);
}

const rows_at = (material, view) => rows_by_place.get(material + "/" + view) || [];
const settings_at = (material, view) => [...rows_at(material, view), ...(sweep_by_place.get(material + "/" + view) || [])];
const row_at = (material, view, technique) => rows_at(material, view).find((row) => row.t === technique);
const views_of = (material) => page.views.map((_, v) => v).filter((v) => rows_at(material, v).length);
const techniques_of = (material) => {
    const found = new Set(page.rows.filter((row) => row.m === material).map((row) => row.t));
    return page.techniques.map((_, t) => t).filter((t) => found.has(t));
};

const view_title = (material, view) => {
    const row = rows_at(material, view)[0];
    const id = page.views[view];
    return row && String(row.e) !== id ? id + ", " + row.e + "°" : id + "°";
};

// Which picture of a row a mode shows.
const modes = [
    { id: "picture", title: "Picture", path: 0 },
    { id: "wrong", title: "Where it is wrong", path: 1 },
    { id: "fetches", title: "Fetches", path: 2 },
];
const reference_path = 3;
const picture_of = (row, mode) => (row && row.p ? row.p[modes.find((m) => m.id === mode).path] : "");

// --- words -----------------------------------------------------------------------------------------------------------------

// Three digits that matter; never an exponent a reader would have to decode.
function digits(value, count = 3) {
    if (value === 0) return "0";
    const exponent = Math.floor(Math.log10(Math.abs(value)));
    if (exponent < -6) return "< 0.000001";
    return value.toFixed(Math.max(0, Math.min(8, count - 1 - exponent)));
}

// A number as it stands under a header that names its unit.
function shown(value, column) {
    if (value === null || value === undefined) return "–";
    if (value === Infinity) return "∞";
    return digits(column.unit === "share" ? value * 100 : value);
}
const unit_of = (column) => (column.unit === "share" ? "%" : column.unit);
function with_unit(value, column) {
    const unit = unit_of(column);
    return shown(value, column) + (unit && value !== null ? (unit === "°" ? unit : "\u202f" + unit) : "");
}

const wrong_share = (row) => value_of(row, "wrong");

// A round number as a limit: no digits that say nothing.
function limit(value, column) {
    const unit = unit_of(column);
    return "≤ " + +(column.unit === "share" ? value * 100 : value).toPrecision(2) + (unit ? "\u202f" + unit : "");
}

const of_hundred = (share) => (share === 0 ? "none" : digits(share * 100, 2) + "\u202f%");

// What a picture shows to someone who cannot see it: what is wrong, how far, and where.
function picture_words(row, mode) {
    const technique = page.techniques[row.t].title;
    const subject = `${technique}${row.s ? " with " + row.s : ""} on ${page.materials[row.m].title} seen at ${row.e} degrees`;
    if (mode === "fetches") {
        const mean = value_of(row, "fetches.mean");
        return `Fetches per pixel of ${subject}: ` + (mean === null ? "not counted." : `${digits(mean)} on average, at most ${digits(value_of(row, "fetches.max"))}.`);
    }
    const missed = value_of(row, "missed_first_hit"), early = value_of(row, "early_hit"), far = value_of(row, "uv_error_texels.p99");
    const parts = [];
    if (missed !== null && early !== null) {
        parts.push(missed + early === 0 ? "no pixel is wrong" : `${of_hundred(missed)} of the first hits are missed, ${of_hundred(early)} are early`);
    }
    if (far) parts.push(`99 of 100 pixels are within ${digits(far, 2)} texels`);
    return `${mode === "wrong" ? "Where it is wrong: " : ""}${subject}: ${parts.join("; ") || "not measured"}.${row.w ? " " + row.w : ""}`;
}

// --- elements ----------------------------------------------------------------------------------------------------------------

const $ = (id) => document.getElementById(id);

function el(tag, attributes = {}, ...children) {
    const element = document.createElement(tag);
    set_attributes(element, attributes);
    element.append(...children.filter((child) => child !== null && child !== undefined && child !== ""));
    return element;
}
function svg(tag, attributes = {}, ...children) {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    set_attributes(element, attributes);
    element.append(...children);
    return element;
}
function set_attributes(element, attributes) {
    for (const [name, value] of Object.entries(attributes)) {
        if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
        else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : value);
    }
}

function fill_select(select, options, chosen) {
    select.replaceChildren(...options.map(([value, text]) => el("option", { value, selected: String(value) === String(chosen) }, text)));
}

// Radio buttons drawn as one switch.
function fill_switch(holder, name, options, chosen, choose) {
    holder.replaceChildren(...options.map(({ id, title }) =>
        el("label", {}, el("input", { type: "radio", name, value: id, checked: id === chosen, onchange: () => choose(id) }), el("span", {}, title))));
}
const set_switch = (holder, chosen) => { for (const input of holder.querySelectorAll("input")) input.checked = input.value === chosen; };

// The scale of the error or fetches pictures; for plain pictures, what they have in common.
function fill_legend(holder, mode) {
    const legend = mode === "wrong" ? page.legends.error : mode === "fetches" ? page.legends.fetches : null;
    if (!legend || !legend.stops.length) {
        holder.replaceChildren(el("span", { class: "note" }, mode === "picture" ? "same light, same exposure everywhere" : ""));
        return;
    }
    // A stop is [position, colour, label]; a key is [colour, label].
    // A label that would run into the one before it is left out.
    let last = -1;
    const labelled = legend.stops.filter(([position, , label]) => label && (position - last >= 0.1 ? ((last = position), true) : false));
    const bar = legend.stops.map(([position, colour]) => `${colour} ${100 * position}%`).join(",");
    holder.replaceChildren(
        el("span", { class: "legend-title" }, legend.title + (legend.unit ? ", " + legend.unit : "")),
        el("span", { class: "legend-end" }, legend.low),
        el("div", { class: "legend-scale", role: "img", "aria-label": `Scale from ${legend.low} to ${legend.high}: ${labelled.map(([, , label]) => label).join(", ")} ${legend.unit}` },
            el("div", { class: "legend-bar", style: `background:linear-gradient(90deg,${bar})` }),
            el("div", { class: "legend-labels", "aria-hidden": "true" }, ...labelled.map(([position, , label]) => el("span", { style: `left:${100 * position}%` }, label)))),
        el("span", { class: "legend-end" }, legend.high),
        ...legend.keys.map(([colour, label]) => el("span", { class: "legend-key" }, el("i", { style: `background:${colour}` }), label)));
}

// A small text that follows the pointer or sits by a focused mark.
function show_tip(lines, x, y) {
    const tip = $("tip");
    tip.replaceChildren(...lines.map((line, i) => el(i ? "div" : "strong", {}, line)));
    tip.hidden = false;
    const { width, height } = tip.getBoundingClientRect();
    tip.style.left = Math.max(8, Math.min(x + 14, innerWidth - width - 8)) + "px";
    tip.style.top = (y + 18 + height > innerHeight ? y - height - 12 : y + 18) + "px";
}
const hide_tip = () => { $("tip").hidden = true; };
