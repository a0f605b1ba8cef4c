// What the catalogue says of each technique that was run, and under which conditions each material was read.
function draw_about() {
    $("about").replaceChildren(...page.techniques.map((technique) => {
        const heading = el("h3", { id: "technique-" + technique.id }, technique.year ? el("span", { class: "year" }, technique.year) : "", technique.title, technique.exact ? el("span", { class: "exact" }, "exact") : "");
        if (!technique.known) return el("article", {}, heading, el("p", {}, "Not in this version's catalogue; its rows were written by another."));
        const facts = el("dl", {});
        const fact = (term, ...description) => facts.append(el("dt", {}, term), el("dd", {}, ...description));
        fact("Paper", `${technique.author} ${technique.year}. `, el("cite", {}, technique.paper));
        if (technique.maps.length) fact("Maps", ...technique.maps.flatMap((map, i) => [i ? ", " : "", el("span", { title: map.summary }, map.title)]));
        if (technique.knobs.length)
            fact("Knobs", ...technique.knobs.flatMap((knob, i) => [i ? "; " : "", el("span", { title: knob.help }, `${knob.title} ${knob.value}${knob.unit ? " " + knob.unit : ""}`)]));
        const shows = Object.entries(technique.effects).filter(([, claimed]) => claimed).map(([effect]) => effect);
        fact("Shows", shows.join(", ") || "shading only");
        fact("Promises", technique.promise);
        fact("Fails", technique.limits);
        if (page.docs) fact("More", el("a", { href: page.docs.replace(/\/?$/, "/") + technique.id + ".md" }, "its chapter"));
        return el("article", {}, heading, el("p", { class: "idea" }, sentence(technique.summary)), facts);
    }));
}
const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1) + (text.endsWith(".") ? "" : ".");

function draw_materials() {
    const head = ["Material", "Height map", "Height scale", "Zero level", "Size", "What was assumed", "Input"];
    $("materials").replaceChildren(el("table", { class: "plain" },
        el("thead", {}, el("tr", {}, ...head.map((title) => el("th", { scope: "col" }, title)))),
        el("tbody", {}, ...page.materials.map((m) => el("tr", {}, el("th", { scope: "row" }, m.title),
            el("td", {}, m.width ? `${m.width} × ${m.height}` : "–"), el("td", {}, m.scale ?? "–"), el("td", {}, m.zero ?? "–"), el("td", {}, m.size_m ? m.size_m + " m" : "not given"),
            el("td", { class: "notes" }, ...(m.notes && m.notes.length ? m.notes.map((note) => el("p", {}, note)) : ["nothing"])), el("td", {}, el("code", { title: m.hash || "" }, (m.hash || "–").slice(0, 12))))))));
}
