// "inside", "outside", or "–" where no promise was judged.
function budget_of(row) {
    const astray = value_of(row, "astray"), allowed = value_of(row, "astray_budget");
    return astray === null || allowed === null ? "–" : astray <= allowed ? "inside" : "outside";
}

// All rows: sortable by any column, filtered by material, view and words, copied as CSV. Rows are built once and then only moved;
// a long table is laid out as far as it is scrolled.
function make_table(state, open) {
    const columns = page.columns;
    // Identical pictures have no finite PSNR; they are the best there is, not the unknown.
    for (const row of page.rows) if (value_of(row, "psnr_db") === null && value_of(row, "flip") === 0) row.n[column_index.get("psnr_db")] = Infinity;
    let sort = { key: "technique", down: false };
    let shown_rows = [];
    const keys = [
        { key: "technique", title: "Technique", of: (row) => row.t },
        { key: "material", title: "Material", of: (row) => page.materials[row.m].title },
        { key: "view", title: "View", of: (row) => row.e, number: true },
        { key: "budget", title: "Budget", help: "whether no more pixels are astray than the catalogue allows", of: (row) => budget_of(row) },
        { key: "setting", title: "Setting", of: (row) => row.s },
        ...columns.map((c, i) => ({ key: c.id, title: c.title, unit: unit_of(c), help: c.help, column: c, of: (row) => row.n[i], number: true, descending_first: !c.small })),
    ];
    const lines = new Map();  // row -> tr
    const text_of = (row) => [page.techniques[row.t].title, page.techniques[row.t].id, page.materials[row.m].title, page.views[row.v], row.s].join(" ").toLowerCase();
    const line_of = (row) => {
        if (!lines.has(row)) {
            lines.set(row, el("tr", {},
                el("th", { scope: "row" }, el("button", { type: "button", class: "link", onclick: () => open(row) }, page.techniques[row.t].title)),
                el("td", {}, page.materials[row.m].title), el("td", {}, view_title(row.m, row.v)), el("td", { class: "budget " + budget_of(row) }, budget_of(row)), el("td", {}, row.s),
                ...columns.map((c, i) => el("td", { class: "number" + (row.n[i] === null ? " none" : ""), title: row.n[i] === null ? reason_of(row, c.id) : null }, shown(row.n[i], c)))));
        }
        return lines.get(row);
    };
    const heads = keys.map((k) => el("th", { scope: "col", class: k.number && k.column ? "number" : "", title: k.help ?? null, "data-key": k.key },
        el("button", { type: "button", onclick: () => sort_by(k) }, k.title, k.unit ? el("small", {}, k.unit) : "")));
    const body = el("tbody");
    const widths = keys.map((k) => el("col", { class: k.key === "technique" || k.key === "setting" ? "wide" : k.column ? "narrow" : "middling" }));
    $("rows").replaceChildren(el("table", { class: "plain rows" }, el("colgroup", {}, ...widths), el("thead", {}, el("tr", {}, ...heads)), body));

    function sort_by(key) {
        sort = { key: key.key, down: sort.key === key.key ? !sort.down : Boolean(key.descending_first) };
        draw();
    }
    function draw() {
        const material = $("table-material").value, view = $("table-view").value;
        const words = $("filter").value.toLowerCase().split(/\s+/).filter(Boolean);
        shown_rows = page.rows.filter((row) => (material === "" || row.m === +material) && (view === "" || row.v === +view) && words.every((word) => text_of(row).includes(word)));
        const key = keys.find((k) => k.key === sort.key);
        const direction = sort.down ? -1 : 1;
        shown_rows.sort((a, b) => {
            const x = key.of(a), y = key.of(b);
            if (x === null || y === null) return (x === null) - (y === null);  // what is missing comes last either way
            return direction * (typeof x === "string" ? x.localeCompare(y) : x - y) || a.m - b.m || a.v - b.v || a.t - b.t;
        });
        best_numbers = find_best();
        body.replaceChildren();
        lay_out(page_rows);
        $("rows").scrollTop = 0;
        heads.forEach((head, i) => (keys[i] === key ? head.setAttribute("aria-sort", sort.down ? "descending" : "ascending") : head.removeAttribute("aria-sort")));
        $("table-count").textContent = `${shown_rows.length} of ${page.rows.length} rows`;
    }
    const page_rows = 150;
    let best_numbers = new Map();
    function lay_out(count) {
        const from = body.rows.length;
        for (const row of shown_rows.slice(from, from + count)) {
            const line = line_of(row), numbers = best_numbers.get(row.m + "/" + row.v);
            columns.forEach((_, i) => line.cells[i + 5].classList.toggle("best", row.n[i] !== null && row.n[i] === numbers[i]));
            body.append(line);
        }
    }
    $("rows").addEventListener("scroll", ({ target }) => {
        if (target.scrollTop + 2 * target.clientHeight > target.scrollHeight && body.rows.length < shown_rows.length) lay_out(page_rows);
    });
    addEventListener("beforeprint", () => lay_out(shown_rows.length));
    function find_best() {
        const best_at = new Map();  // place -> best number per column
        const better = (a, b, small) => (small ? a < b : a > b);
        for (const row of shown_rows) {
            const place = row.m + "/" + row.v;
            if (!best_at.has(place)) best_at.set(place, columns.map(() => null));
            const numbers = best_at.get(place);
            columns.forEach((c, i) => { if (row.n[i] !== null && (numbers[i] === null || better(row.n[i], numbers[i], c.small))) numbers[i] = row.n[i]; });
        }
        return best_at;
    }
    function csv() {
        const quoted = (text) => (/[",\n]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text);
        const head = ["technique", "material", "view", "elevation_deg", "inside_budget", "setting", ...columns.map((c) => c.id.replace(".", "_"))];
        return [head, ...shown_rows.map((row) => [page.techniques[row.t].id, page.materials[row.m].id, page.views[row.v], row.e, { inside: "yes", outside: "no" }[budget_of(row)] ?? "", row.s, ...row.n.map((v) => (Number.isFinite(v) ? v : ""))])]
            .map((line) => line.map((field) => quoted(String(field))).join(",")).join("\n") + "\n";
    }
    async function copy() {
        const button = $("copy"), text = csv();
        let done = false;
        try {
            await navigator.clipboard.writeText(text);
            done = true;
        } catch {  // pages from disk may be refused the clipboard; the old way still works there
            const area = el("textarea", { readonly: true, style: "position:fixed;opacity:0" });
            document.body.append(area);
            area.value = text;
            area.select();
            done = document.execCommand("copy");
            area.remove();
        }
        button.textContent = done ? "Copied" : "Not allowed here: see results.csv";
        button.dataset.csv = text.length;
        setTimeout(() => { button.textContent = "Copy as CSV"; }, 2000);
    }

    function set_material(material) {
        fill_select($("table-material"), [["", "all"], ...page.materials.map((m, i) => [i, m.title])], material);
        draw();
    }
    fill_select($("table-view"), [["", "all"], ...page.views.map((id, v) => [v, id])], "");
    for (const id of ["table-material", "table-view"]) $(id).addEventListener("change", draw);
    $("filter").addEventListener("input", draw);
    $("copy").addEventListener("click", copy);
    return { set_material };
}
