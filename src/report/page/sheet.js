// The contact sheet: techniques down by year, views across, one material at a time.
function draw_sheet(state, open) {
    const material = state.material;
    const views = views_of(material);
    const cell = (row, mode, path, words, caption, choose) => {
        const [width, height] = page.size;
        const frame = el("span", { class: "thumb", style: `aspect-ratio:${width || 16}/${height || 9}` });
        if (path) frame.append(el("img", { src: path, alt: words, loading: "lazy", decoding: "async", width, height }));
        else frame.append(el("span", { class: "no-picture" }, no_picture_reason(row)));
        return el("td", {}, el("button", { type: "button", class: "cell", onclick: choose, "data-technique": row ? row.t : "", "data-view": row ? row.v : "" }, frame, caption));
    };
    const head = el("tr", {}, el("th", { scope: "col" }, "Technique"), ...views.map((v) => el("th", { scope: "col" }, view_title(material, v))));
    const reference = el("tr", { class: "reference" }, el("th", { scope: "row" }, el("b", {}, "Reference"), el("small", {}, "the exact answer, cell by cell in double precision")));
    for (const v of views) {
        const row = rows_at(material, v).find((r) => r.p[reference_path]) || rows_at(material, v)[0];
        reference.append(cell(row, "picture", row.p[reference_path], `Reference: ${page.materials[material].title} seen at ${row.e} degrees, exact.`, "",
            () => open({ view: v, right: "reference" })));
    }
    const body = techniques_of(material).map((t) => {
        const technique = page.techniques[t];
        const line = el("tr", { "data-technique": t }, el("th", { scope: "row" },
            technique.year ? el("span", { class: "year" }, technique.year) : "", el("b", {}, technique.title),
            technique.summary ? el("small", {}, technique.summary) : ""));
        for (const v of views) {
            const row = row_at(material, v, t);
            if (!row) {
                line.append(el("td", {}, el("span", { class: "note" }, "not run")));
                continue;
            }
            const wrong = wrong_share(row), fetches = value_of(row, "fetches.mean"), time = value_of(row, "gpu_ms.median");
            const caption = el("span", { class: "caption" },
                el("b", { class: wrong === 0 ? "right" : "" }, wrong === null ? "– wrong" : wrong === 0 ? "none wrong" : digits(wrong * 100, 2) + "\u202f% wrong"),
                fetches === null ? "" : el("span", {}, digits(fetches) + " fetches"), time === null ? "" : el("span", {}, digits(time) + "\u202fms"));
            line.append(cell(row, state.mode, picture_of(row, state.mode), picture_words(row, state.mode), caption, () => open({ view: v, left: t })));
        }
        return line;
    });
    $("sheet-grid").replaceChildren(el("table", { class: "sheet", style: `--views:${views.length}` }, el("thead", {}, head), el("tbody", {}, reference, ...body)));
}
