// Values behind the pictures. A page opened from disk may not read its own pictures' pixels, but it may load scripts: each row's
// script hands over its planes, packed as src/report/pixels.h describes.
const pixel_files = new Map();  // path -> {planes, width, height} | {waiting} | {none}

globalThis.relievo_pixels = (payload) => {
    const path = document.currentScript.getAttribute("src");
    unpack(payload).then((file) => settle(path, file), () => settle(path, { none: "This browser cannot unpack the values behind the pictures." }));
};
function settle(path, file) {
    const waiting = pixel_files.get(path);
    pixel_files.set(path, file);
    waiting?.done?.();
}
function load_pixels(path, done) {
    if (!path) return { none: "The values behind this picture were not kept." };
    if (!pixel_files.has(path)) {
        pixel_files.set(path, { waiting: "Reading the values …", done });
        document.head.append(el("script", { src: path, onerror: () => settle(path, { none: "The file with the values is missing: " + path }) }));
    }
    return pixel_files.get(path);
}
async function unpack({ width, height, planes, data, uv_from, uv_to }) {
    const packed = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const file = { width, height, uv_from, uv_to, planes: {} };
    planes.forEach((name, i) => {
        const plane = bytes.subarray(i * width * height, (i + 1) * width * height);
        for (let y = 0; y < height; ++y)  // rows were stored as differences from the left
            for (let x = 1; x < width; ++x) plane[y * width + x] += plane[y * width + x - 1];
        file.planes[name] = plane;
    });
    return file;
}

// The reverse of the writer's scale: sign, and a logarithm of the size.
function unscaled(byte, scale) {
    const level = (byte << 24) >> 24;
    return Math.sign(level) * (Math.pow(2, Math.abs(level) / scale.levels_per_octave) - 1) * scale.smallest;
}
const offset_scale = { smallest: 1 / 32, levels_per_octave: 8 };
const height_scale = { smallest: 1 / 1024, levels_per_octave: 12 };
const verdicts = ["beside the surface", "right", "missed: late", "early", "missed: nothing found", "hit where there is none"];

function pixel_values(row, x, y, done) {
    const file = load_pixels(row.px && row.px[0], done);
    if (!file.planes) return file;
    const truth = load_pixels(row.px[1], done);
    const at = y * file.width + x;
    const planes = file.planes;
    const verdict = planes.verdict[at];
    const values = { verdict: verdicts[verdict], fetches: planes.fetches_high[at] * 256 + planes.fetches_low[at] };
    if (verdict === 0) return { verdict: verdicts[0], reference: { verdict: verdicts[0] } };
    const found = verdict !== 4;
    const du = unscaled(planes.offset_u[at], offset_scale), dv = unscaled(planes.offset_v[at], offset_scale);
    if (found && verdict !== 5) values.error = digits(Math.hypot(du, dv), 2) + " texels";
    if (truth.planes && verdict !== 5) {
        const word = (name) => truth.planes[name + "_high"][at] * 256 + truth.planes[name + "_low"][at];
        const coordinate = (name) => truth.uv_from + (truth.uv_to - truth.uv_from) * word(name) / 65535;
        const u = coordinate("u"), v = coordinate("v"), h = word("height") / 65535;
        const [w, l] = [page.materials[row.m].width, page.materials[row.m].height];
        const uv = (a, b) => a.toFixed(4) + ", " + b.toFixed(4);
        values.reference = { verdict: "exact", uv: uv(u, v), height: h.toFixed(4), error: "0", fetches: "–" };
        if (found) {
            if (w && l) values.uv = uv(u + du / w, v + dv / l);
            values.height = (h + unscaled(planes.offset_height[at], height_scale)).toFixed(3);
        }
    }
    return values;
}
