#include "explain/panel.h"

#include "explain/labels.h"

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

constexpr double dot_radius = 3.2;

// The line without the points that lie within `tolerance` pixels of it (Douglas and Peucker 1973).
std::vector<Vec2d> simplified(const std::vector<Vec2d>& line, double tolerance) {
    std::vector<bool> kept(line.size(), false);
    kept.front() = kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        const Vec2d along = line[b] - line[a];
        const double norm = std::max(length(along), 1e-9);
        double farthest = 0;
        std::size_t at = a;
        for (std::size_t i = a + 1; i < b; ++i) {
            const Vec2d d = line[i] - line[a];
            const double off = std::abs(along.x * d.y - along.y * d.x) / norm;
            if (off > farthest) farthest = off, at = i;
        }
        if (farthest <= tolerance) continue;
        kept[at] = true;
        open.push_back({a, at});
        open.push_back({at, b});
    }
    std::vector<Vec2d> result;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (kept[i]) result.push_back(line[i]);
    return result;
}

class PanelPainter {
public:
    PanelPainter(Drawing& drawing, const Panel& panel, const Section& section, const HeightField& field, const Search& search)
        : drawing_(drawing), panel_(panel), section_(section), field_(field), search_(search), labels_(panel.box) {}

    void draw(PanelText text) {
        ground();
        for (const Step& step : search_.steps) shape(step);
        line(profile_, Ink::surface, 1.6);
        polygon();
        for (const Step& step : search_.steps) slope(step);
        for (const Chord& c : search_.chord) secant(c.x0, c.z0, c.x1, c.z1);
        ray();
        for (const Step& step : search_.steps) whisker(step);
        for (const Step& step : search_.steps) point(step);
        frame();
        hits(text);
        for (const Step& step : search_.steps) number(step);
        drawing_.marks.push_back(Path{.points = {{panel_.box.left, panel_.box.top}, {panel_.box.right, panel_.box.top}, {panel_.box.right, panel_.box.bottom}, {panel_.box.left, panel_.box.bottom}},
                                      .closed = true, .ink = Ink::grid, .width = 1});
    }

private:
    void line(const std::vector<Vec2d>& points, Ink ink, double width, double opacity = 1, bool dashed = false) {
        for (auto& part : clipped_line(points, panel_.box))
            drawing_.marks.push_back(Path{.points = std::move(part), .ink = ink, .width = width, .opacity = opacity, .dashed = dashed});
    }
    void area(const std::vector<Vec2d>& points, Ink ink, double fill) {
        auto part = clipped_area(points, panel_.box);
        if (part.size() > 2) drawing_.marks.push_back(Path{.points = std::move(part), .closed = true, .ink = ink, .fill = fill});
    }

    // A dashed line that labels keep away from.
    void clear_line(Vec2d a, Vec2d b, Ink ink, double width) {
        for (const auto& part : clipped_line({a, b}, panel_.box)) labels_.keep_clear_line(part.front(), part.back());
        line({a, b}, ink, width, 0.8, true);
    }

    // The declared surface along the section: no less than a point per pixel and four per texel, of which those are kept that
    // show.
    void ground() {
        const double wide = panel_.x_right - panel_.x_left;
        const int count = static_cast<int>(std::clamp(std::max(panel_.box.width(), 4 * wide), 1.0, 20000.0));
        std::vector<Vec2d> points;
        for (int i = 0; i <= count; ++i) {
            const double x = panel_.x_left + wide * i / count;
            points.push_back(panel_.at(x, field_.sample(section_.uv_at(x))));
        }
        profile_ = simplified(points, 0.12);
        std::vector<Vec2d> solid = profile_;
        solid.push_back({panel_.box.right, panel_.box.bottom + 1});
        solid.push_back({panel_.box.left, panel_.box.bottom + 1});
        area(solid, Ink::ground, 1);
        for (std::size_t i = 0; i + 1 < profile_.size(); ++i) labels_.keep_clear_line(profile_[i], profile_[i + 1]);
    }

    // The empty or full space that a step learnt of.
    void shape(const Step& step) {
        switch (step.kind) {
            case StepKind::cone: {
                // As high as the ray's point: below it lies the way that the cone vouches for.
                const double up = std::max(step.z - step.value, 0.0);
                const std::vector<Vec2d> cone{panel_.at(step.x, step.value), panel_.at(step.x - step.size * up, step.value + up), panel_.at(step.x + step.size * up, step.value + up)};
                area(cone, Ink::cone, 0.10);
                line({cone[1], cone[0], cone[2]}, Ink::cone, 1, 0.75);
                break;
            }
            case StepKind::sphere: {
                const double texels = step.size * static_cast<double>(section_.question.height_scale) * section_.texels_per_uv;
                std::vector<Vec2d> ring;
                for (int i = 0; i <= 72; ++i) {
                    const double a = 2 * 3.14159265358979323846 * i / 72;
                    ring.push_back(panel_.at(step.x + texels * std::cos(a), step.z + step.size * std::sin(a)));
                }
                area(ring, Ink::sphere, 0.10);
                line(ring, Ink::sphere, 1, 0.75);
                break;
            }
            case StepKind::node:
            case StepKind::cell: {
                const std::vector<Vec2d> box{panel_.at(step.x, panel_.z_bottom - 1), panel_.at(step.x, step.value), panel_.at(step.x_end, step.value), panel_.at(step.x_end, panel_.z_bottom - 1)};
                const Ink ink = step.kind == StepKind::cell ? Ink::cell : step.skipped ? Ink::node : Ink::opened;
                if (step.skipped) area(box, ink, 0.10);
                if (step.solved) area(box, ink, 0.20);
                line(box, ink, step.solved ? 1.6 : 1, 0.9, step.kind == StepKind::node && !step.skipped);
                if (step.solved)
                    for (const auto& part : clipped_line({box[1], box[2]}, panel_.box)) labels_.keep_clear_line(part.front(), part.back());
                break;
            }
            default: break;
        }
    }

    void secant(double x0, double z0, double x1, double z1) { line({panel_.at(x0, z0), panel_.at(x1, z1)}, Ink::secant, 1.8); }

    void slope(const Step& step) {
        if (step.kind != StepKind::normal) return;
        // A piece of the tangent, 34 pixels long.
        const Vec2d middle = panel_.at(step.x, step.value);
        Vec2d along{panel_.px_per_texel(), -step.size * panel_.px_per_height()};
        along = normalize(along) * 17.0;
        line({middle - along, middle + along}, Ink::normal, 2.2);
    }

    void polygon() {
        const double z = static_cast<double>(section_.question.zero_level);
        const Vec2d a = panel_.at(panel_.x_left, z), b = panel_.at(panel_.x_right, z);
        line({a, b}, Ink::muted, 1, 0.9, true);
    }

    void ray() {
        const double over = std::max(0.0, (panel_.z_top - 1) / section_.drop_per_texel);
        const auto at = [&](double x) { return panel_.at(x, section_.ray_height(x)); };
        const double end = std::max(panel_.x_right, section_.truth.x);
        line({at(-over), at(section_.truth.x)}, Ink::ray, 1.5);
        line({at(section_.truth.x), at(end)}, Ink::ray, 1.2, 0.6, true);
        for (const auto& part : clipped_line({at(-over), at(end)}, panel_.box)) labels_.keep_clear_line(part.front(), part.back());
    }

    void frame() {
        if (!panel_.frame) return;
        const Rect& f = *panel_.frame;
        for (auto& part : clipped_line({{f.left, f.top}, {f.right, f.top}, {f.right, f.bottom}, {f.left, f.bottom}, {f.left, f.top}}, panel_.box)) {
            for (std::size_t i = 0; i + 1 < part.size(); ++i) labels_.keep_clear_line(part[i], part[i + 1]);
            drawing_.marks.push_back(Path{.points = std::move(part), .ink = Ink::muted, .width = 1});
        }
    }

    bool is_point(const Step& step) const { return step.kind != StepKind::node && step.kind != StepKind::cell; }
    Ink ink_of(const Step& step) const {
        if (step.kind == StepKind::normal) return Ink::normal;
        return step.z > step.value ? Ink::above : Ink::below;
    }

    // From the point of the ray to the height that was read there.
    void whisker(const Step& step) {
        if (!is_point(step) || step.kind == StepKind::sphere || step.kind == StepKind::other) return;
        line({panel_.at(step.x, step.z), panel_.at(step.x, step.value)}, ink_of(step), 1, 0.55);
    }

    // Steps that stand closer than their marks are drawn smaller.
    double radius_of(const Step& step) const {
        const std::size_t i = static_cast<std::size_t>(&step - search_.steps.data());
        double nearest = 1e9;
        for (const std::size_t k : {i - 1, i + 1})
            if (k < search_.steps.size() && is_point(search_.steps[k]) && search_.steps[k].kind != StepKind::normal)
                nearest = std::min(nearest, std::abs(search_.steps[k].x - step.x) * panel_.px_per_texel());
        return nearest > 0 && nearest < 9 ? std::max(1.8, dot_radius * nearest / 9) : dot_radius;
    }

    void point(const Step& step) {
        if (!is_point(step)) return;
        const Vec2d p = panel_.at(step.x, step.z);
        if (!panel_.box.contains(p)) return;
        const bool refines = step.kind == StepKind::bisection || step.kind == StepKind::secant;
        drawing_.marks.push_back(Dot{.centre = p, .radius = radius_of(step), .ink = ink_of(step), .hollow = refines, .width = refines ? 1.6 : 1});
        labels_.keep_clear({p.x - 4, p.y - 4, p.x + 4, p.y + 4});
    }

    void number(const Step& step) {
        const Vec2d p = is_point(step) ? panel_.at(step.x, step.z) : panel_.at((std::max(step.x, panel_.x_left) + std::min(step.x_end, panel_.x_right)) / 2, step.value);
        if (!panel_.box.contains(p)) return;
        const Ink ink = step.kind == StepKind::cell ? Ink::cell : step.kind == StepKind::node ? (step.skipped ? Ink::node : Ink::opened) : ink_of(step);
        labels_.place(drawing_, p, is_point(step) ? 6 : 3, std::to_string(step.number), ink, 10);
    }

    void hits(PanelText text) {
        const Vec2d truth = panel_.at(section_.truth.x, section_.truth.z);
        const Vec2d found = panel_.at(search_.found.x, search_.found.z);
        const bool truth_seen = panel_.box.contains(truth), found_seen = search_.has_found && panel_.box.contains(found);
        if (truth_seen) {
            drawing_.marks.push_back(Dot{.centre = truth, .radius = 6.5, .ink = Ink::truth, .hollow = true, .width = 1.8});
            labels_.keep_clear({truth.x - 8, truth.y - 8, truth.x + 8, truth.y + 8});
        }
        if (search_.has_found) {
            // What is painted there is the surface at that texture coordinate, wherever the answer's height lies.
            const double seen = field_.sample(section_.uv_at(search_.found.x));
            if (std::abs(seen - search_.found.z) * panel_.px_per_height() > 8) clear_line(found, panel_.at(search_.found.x, seen), Ink::found, 1.4);
        }
        if (found_seen) {
            const double r = 4.6;
            drawing_.marks.push_back(Path{.points = {found + Vec2d{0, -r - 1.4}, found + Vec2d{r + 1.4, 0}, found + Vec2d{0, r + 1.4}, found + Vec2d{-r - 1.4, 0}}, .closed = true, .ink = Ink::paper, .fill = 1});
            drawing_.marks.push_back(Path{.points = {found + Vec2d{0, -r}, found + Vec2d{r, 0}, found + Vec2d{0, r}, found + Vec2d{-r, 0}}, .closed = true, .ink = Ink::found, .fill = 1});
            labels_.keep_clear({found.x - 6, found.y - 6, found.x + 6, found.y + 6});
        }
        // Apart by less than their own size they share one label.
        const bool together = truth_seen && found_seen && length(truth - found) < 9;
        if (truth_seen && (!together || text == PanelText::always)) labels_.place(drawing_, truth, 9, together ? "first hit, found" : "first hit", Ink::truth, 11, true);
        if (found_seen && !together) labels_.place(drawing_, found, 8, "found", Ink::found, 11, true);
        if (search_.has_found && !found_seen) outside(found);
    }

    // The found hit lies beyond the panel: an arrowhead at the border, in its direction.
    void outside(Vec2d found) {
        const Rect& b = panel_.box;
        if (found.x >= b.left && found.x <= b.right) return;
        const double side = found.x > b.right ? 1 : -1;
        const Vec2d tip{side > 0 ? b.right - 4 : b.left + 4, std::clamp(found.y, b.top + 14, b.bottom - 14)};
        drawing_.marks.push_back(Path{.points = {tip, tip + Vec2d{-9 * side, -6}, tip + Vec2d{-9 * side, 6}}, .closed = true, .ink = Ink::found, .fill = 1});
        labels_.keep_clear({tip.x - 10, tip.y - 7, tip.x + 10, tip.y + 7});
        labels_.place(drawing_, tip + Vec2d{-9 * side, 0}, 8, "found", Ink::found, 11, true);
    }

    Drawing& drawing_;
    const Panel& panel_;
    const Section& section_;
    const HeightField& field_;
    const Search& search_;
    Labels labels_;
    std::vector<Vec2d> profile_;
};

}  // namespace

void draw_panel(Drawing& drawing, const Panel& panel, const Section& section, const HeightField& field, const Search& search, PanelText text) {
    PanelPainter(drawing, panel, section, field, search).draw(text);
}

}  // namespace relievo
