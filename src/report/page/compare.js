// Two pictures on one stage: a divider, or side by side; zoom and pan in step; the values under the pointer.
function make_compare(state, change) {
    const stage = $("stage"), divider = $("divider"), cross = $("cross");
    const panes = [...stage.querySelectorAll(".pane")];
    const images = panes.map((pane) => pane.querySelector("img"));
    const [width, height] = page.size[0] && page.size[1] ? page.size : [16, 9];
    const largest_zoom = 32;
    const view = { zoom: 1, x: 0.5, y: 0.5, split: 0.5 };  // x, y: the point of the picture at the stage's middle
    let pixel = null;
    let shown_rows = [null, null];
    stage.style.setProperty("--aspect", width / height);

    // --- what is on the stage ----------------------------------------------------------------------------------------------

    function draw() {
        const row = row_at(state.material, state.view, state.left);
        const against = state.right === "reference" ? null : row_at(state.material, state.view, +state.right);
        shown_rows = [row, against];
        fill_select($("left"), techniques_of(state.material).map((t) => [t, page.techniques[t].title]), state.left);
        fill_select($("right"), [["reference", "the reference"], ...techniques_of(state.material).map((t) => [t, page.techniques[t].title])], state.right);
        fill_select($("view"), views_of(state.material).map((v) => [v, view_title(state.material, v)]), state.view);
        const any = row || rows_at(state.material, state.view)[0];
        show(0, row, picture_of(row, state.mode), row ? picture_words(row, state.mode) : "", row ? page.techniques[row.t].title : "not run");
        if (state.right === "reference") show(1, any, any.p[reference_path], "The exact reference at the same size.", "Reference");
        else show(1, against, picture_of(against, state.mode), against ? picture_words(against, state.mode) : "", against ? page.techniques[against.t].title : "not run");
        $("verdict").textContent = row ? picture_words(row, "picture") : "This technique was not run here.";
        inspect();
        place();
    }
    function show(side, row, path, words, tag) {
        images[side].hidden = !path;
        if (path) images[side].src = path;
        else images[side].removeAttribute("src");
        images[side].alt = words;
        panes[side].querySelector(".no-picture").textContent = path ? "" : row ? no_picture_reason(row) : "not run on this view";
        panes[side].querySelector(".tag").textContent = tag;
    }

    // --- where it is -------------------------------------------------------------------------------------------------------

    const beside = () => $("beside").checked;
    function pane_box() {
        const box = stage.getBoundingClientRect();
        return { left: box.left, top: box.top, width: beside() ? panes[0].clientWidth : box.width, height: panes[0].clientHeight };
    }
    function place() {
        const half = 0.5 / view.zoom;  // what is visible, on either side of the middle; the picture never leaves the stage
        view.x = Math.min(1 - half, Math.max(half, view.x));
        view.y = Math.min(1 - half, Math.max(half, view.y));
        const transform = `translate(${50 - 100 * view.x * view.zoom}%, ${50 - 100 * view.y * view.zoom}%) scale(${view.zoom})`;
        for (const image of images) image.style.transform = transform;
        stage.classList.toggle("texels", view.zoom * pane_box().width / width >= 2);
        stage.classList.toggle("zoomed", view.zoom > 1);
        stage.classList.toggle("beside", beside());
        stage.style.setProperty("--split", 100 * view.split + "%");
        divider.setAttribute("aria-valuenow", Math.round(100 * view.split));
        divider.setAttribute("aria-valuetext", Math.round(100 * view.split) + " percent technique");
        $("zoom-level").textContent = digits(view.zoom, 2) + "×";
        place_cross();
    }
    function point_at(event) {  // in the picture, [0,1]
        const box = pane_box();
        let x = event.clientX - box.left;
        const second = panes[1].getBoundingClientRect();
        if (beside() && (event.clientX >= second.left && event.clientY >= second.top)) x = event.clientX - second.left;
        const y = event.clientY - (beside() && event.clientY >= second.top && event.clientX >= second.left ? second.top : box.top);
        return { x: view.x + (x / box.width - 0.5) / view.zoom, y: view.y + (y / box.height - 0.5) / view.zoom };
    }
    function zoom_to(zoom, at = { x: view.x, y: view.y }) {
        zoom = Math.min(largest_zoom, Math.max(1, zoom));
        view.x = at.x + (view.x - at.x) * view.zoom / zoom;  // the point stays under the pointer
        view.y = at.y + (view.y - at.y) * view.zoom / zoom;
        view.zoom = zoom;
        place();
    }
    function split_at(event) {
        const box = stage.getBoundingClientRect();
        view.split = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
        place();
    }

    // --- pointer -----------------------------------------------------------------------------------------------------------

    const pointers = new Map();
    let grip = null;  // what the pressed pointer moves: "split" or "pan"
    let pinch = 0;
    const near_divider = (event) => {
        const box = stage.getBoundingClientRect();
        return !beside() && Math.abs(event.clientX - box.left - view.split * box.width) < (event.pointerType === "mouse" ? 12 : 28);
    };
    const spread = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY); };

    stage.addEventListener("pointerdown", (event) => {
        if (event.button > 0) return;
        pointers.set(event.pointerId, event);
        if (pointers.size === 2) pinch = spread() / view.zoom;
        grip = !beside() && (view.zoom === 1 || (near_divider(event) && !($("follow").checked && event.pointerType === "mouse"))) ? "split" : "pan";
        stage.setPointerCapture(event.pointerId);
        stage.classList.add("held");
        if (event.target.closest("#divider")) divider.focus({ preventScroll: true });
        else stage.focus({ preventScroll: true });
        if (grip === "split") split_at(event);
        event.preventDefault();
    });
    stage.addEventListener("pointermove", (event) => {
        const before = pointers.get(event.pointerId);
        if (before) pointers.set(event.pointerId, event);
        if (pointers.size === 2 && before) zoom_to(spread() / pinch, point_at(event));
        else if (before && grip === "pan") {
            const box = pane_box();
            view.x -= (event.clientX - before.clientX) / box.width / view.zoom;
            view.y -= (event.clientY - before.clientY) / box.height / view.zoom;
            place();
        } else if (!beside() && (before || ($("follow").checked && event.pointerType === "mouse"))) split_at(event);
        const at = point_at(event);
        pixel = { x: Math.min(width - 1, Math.max(0, Math.floor(at.x * width))), y: Math.min(height - 1, Math.max(0, Math.floor(at.y * height))) };
        inspect();
        place_cross();
    });
    for (const name of ["pointerup", "pointercancel"]) {
        stage.addEventListener(name, (event) => {
            pointers.delete(event.pointerId);
            if (!pointers.size) stage.classList.remove("held");
        });
    }
    stage.addEventListener("wheel", (event) => {
        // The wheel scrolls the page until the reader has chosen the picture.
        if (!event.ctrlKey && !stage.contains(document.activeElement)) return;
        event.preventDefault();
        zoom_to(view.zoom * Math.exp(-event.deltaY * 0.002), point_at(event));
    }, { passive: false });
    stage.addEventListener("dblclick", (event) => zoom_to(view.zoom * 2, point_at(event)));
    $("zoom-in").addEventListener("click", () => zoom_to(view.zoom * 2));
    $("zoom-out").addEventListener("click", () => zoom_to(view.zoom / 2));
    $("zoom-fit").addEventListener("click", () => zoom_to(1));
    for (const id of ["beside", "follow"]) $(id).addEventListener("change", place);
    for (const side of ["left", "right"]) $(side).addEventListener("change", (event) => change({ [side]: event.target.value === "reference" ? "reference" : +event.target.value }));
    $("view").addEventListener("change", (event) => change({ view: +event.target.value }));
    addEventListener("resize", place);

    // --- keyboard ----------------------------------------------------------------------------------------------------------

    const next = (list, current, by) => list[(list.indexOf(current) + by + list.length) % list.length];
    stage.addEventListener("keydown", (event) => {
        if (event.altKey || event.ctrlKey || event.metaKey) return;
        if (event.target === divider && event.key in { ArrowLeft: 1, ArrowRight: 1, Home: 1, End: 1 }) {
            view.split = event.key === "Home" ? 0 : event.key === "End" ? 1 : Math.min(1, Math.max(0, view.split + (event.key === "ArrowLeft" ? -0.02 : 0.02)));
            place();
        } else if (event.key === "ArrowDown" || event.key === "ArrowUp") change({ left: next(techniques_of(state.material), state.left, event.key === "ArrowDown" ? 1 : -1) });
        else if (event.key === "ArrowRight" || event.key === "ArrowLeft") change({ view: next(views_of(state.material), state.view, event.key === "ArrowRight" ? 1 : -1) });
        else if (event.key >= "1" && event.key <= String(modes.length)) change({ mode: modes[event.key - 1].id });
        else if (event.key === "+" || event.key === "=") zoom_to(view.zoom * 2);
        else if (event.key === "-") zoom_to(view.zoom / 2);
        else if (event.key === "0") zoom_to(1);
        else return;
        event.preventDefault();
    });

    // --- values under the pointer ------------------------------------------------------------------------------------------

    function place_cross() {
        cross.hidden = !pixel || view.zoom * pane_box().width / width < 4;
        if (cross.hidden) return;
        const box = pane_box();
        const size = view.zoom * box.width / width;
        cross.style.cssText = `left:${((pixel.x / width - view.x) * view.zoom + 0.5) * box.width}px;top:${((pixel.y / height - view.y) * view.zoom + 0.5) * box.height}px;width:${size}px;height:${size}px`;
    }
    function inspect() {
        const subjects = shown_rows.filter(Boolean);
        if (!pixel) {
            $("inspector").replaceChildren(el("p", { class: "note" }, "Point at the pictures to read the values of a pixel."));
            return;
        }
        const values = subjects.map((row) => pixel_values(row, pixel.x, pixel.y, inspect));
        const columns = [];
        const right = state.right === "reference" && values[0]?.reference ? [{ title: "Reference", ...values[0].reference }] : [];
        subjects.forEach((row, i) => columns.push({ title: page.techniques[row.t].title, ...values[i] }));
        columns.push(...right);
        const waiting = values.find((value) => value.waiting || value.none);
        const lines = [["Verdict", "verdict"], ["Hit at", "uv"], ["Height", "height"], ["UV error", "error"], ["Fetches", "fetches"]];
        $("inspector").replaceChildren(el("p", { class: "note" }, `Pixel ${pixel.x}, ${pixel.y}` + (waiting ? ". " + (waiting.waiting || waiting.none) : "")),
            waiting && !values.some((value) => value.verdict) ? "" : el("table", { class: "plain" },
                el("thead", {}, el("tr", {}, el("td", {}), ...columns.map((c) => el("th", { scope: "col" }, c.title)))),
                el("tbody", {}, ...lines.map(([title, key]) => el("tr", {}, el("th", { scope: "row" }, title), ...columns.map((c) => el("td", {}, c[key] ?? "–")))))));
    }

    return { draw };
}
