// What is chosen, kept in one place; a change redraws only what depends on it.
function main() {
    const first_view = () => views_of(state.material)[0];
    const state = { material: page.rows[0].m, mode: "picture", view: 0, left: 0, right: "reference", metric: "", plot_view: 0 };
    const remembered = new URLSearchParams(location.hash.includes("=") ? location.hash.slice(1) : "");
    const index_in = (list, id) => list.findIndex((entry) => (entry.id ?? entry) === id);
    if (index_in(page.materials, remembered.get("material")) >= 0) state.material = index_in(page.materials, remembered.get("material"));
    state.view = first_view();
    if (views_of(state.material).includes(index_in(page.views, remembered.get("view")))) state.view = index_in(page.views, remembered.get("view"));
    state.left = most_telling(state);
    if (techniques_of(state.material).includes(index_in(page.techniques, remembered.get("technique")))) state.left = index_in(page.techniques, remembered.get("technique"));
    state.plot_view = state.view;
    state.metric = error_columns()[0].id;

    const compare = make_compare(state, change);
    const table = make_table(state, (row) => { change({ material: row.m, view: row.v, left: row.t }); reveal("compare"); });

    function change(update) {
        const before = { ...state };
        Object.assign(state, update);
        if (!views_of(state.material).includes(state.view)) state.view = first_view();
        if (!techniques_of(state.material).includes(state.left)) state.left = techniques_of(state.material)[0];
        if (state.view !== before.view && !("plot_view" in update)) state.plot_view = state.view;
        const changed = (...names) => names.some((name) => state[name] !== before[name]);
        if (changed("material")) {
            fill_choices();
            table.set_material(state.material);
        }
        if (changed("material", "mode")) draw_all_pictures();
        if (changed("material", "mode", "view", "left", "right")) compare.draw();
        if (changed("material", "metric", "plot_view")) draw_costs();
        if (changed("material", "view", "left")) {
            const query = new URLSearchParams({ material: page.materials[state.material].id, view: page.views[state.view], technique: page.techniques[state.left].id });
            try { history.replaceState(null, "", "#" + query); } catch { /* some browsers forbid it for files; the page works without */ }
        }
    }

    const reveal = (id) => $(id).scrollIntoView({ block: "start", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
    const open = (update) => { change(update); reveal("compare"); $("stage").focus({ preventScroll: true }); };

    function fill_choices() {
        for (const name of document.querySelectorAll(".material-name")) name.textContent = page.materials[state.material].title;
        fill_select($("material"), page.materials.map((m, i) => [i, m.title]), state.material);
        fill_select($("plot-view"), views_of(state.material).map((v) => [v, view_title(state.material, v)]), state.plot_view);
    }
    function draw_all_pictures() {
        set_switch($("sheet-mode"), state.mode);
        set_switch($("compare-mode"), state.mode);
        fill_legend($("sheet-legend"), state.mode);
        fill_legend($("compare-legend"), state.mode);
        draw_sheet(state, open);
    }
    function draw_costs() {
        $("metric").value = state.metric;
        $("plot-view").value = state.plot_view;
        $("metric-help").textContent = column_of(state.metric).help;
        draw_plots(state, (row) => open({ view: row.v, left: row.t, mode: state.mode }));
        draw_equal(state);
    }

    const count = (n, one, many) => n + " " + (n === 1 ? one : many);
    $("scope").textContent = `${count(page.techniques.length, "technique", "techniques")} on ${count(page.materials.length, "material", "materials")} from ${count(page.views.length, "view", "views")}: `
        + `${count(page.rows.length, "row", "rows")}${page.sweep.length ? `, and ${count(page.sweep.length, "more setting", "more settings")} for the plots` : ""}. `
        + "A pixel is wrong when its first hit is off by more than half a texel along the ray, or not found at all.";
    $("material").addEventListener("change", (event) => change({ material: +event.target.value }));
    for (const id of ["sheet-mode", "compare-mode"]) fill_switch($(id), id, modes, state.mode, (mode) => change({ mode }));
    fill_select($("metric"), error_columns().map((c) => [c.id, c.title + (unit_of(c) ? ", " + unit_of(c) : "")]), state.metric);
    $("metric").addEventListener("change", (event) => change({ metric: event.target.value }));
    $("plot-view").addEventListener("change", (event) => change({ plot_view: +event.target.value }));
    fill_choices();
    draw_all_pictures();
    compare.draw();
    draw_costs();
    table.set_material(state.material);
    draw_about();
    draw_materials();
}

// The technique shown first: it searches, and is wrong most often where it does.
function most_telling(state) {
    const candidates = rows_at(state.material, state.view).filter((row) => page.techniques[row.t].effects?.["self-occlusion"] && !page.techniques[row.t].exact);
    candidates.sort((a, b) => (wrong_share(b) ?? 0) - (wrong_share(a) ?? 0));
    return (candidates[Math.floor(candidates.length / 2)] || rows_at(state.material, state.view)[0]).t;
}
