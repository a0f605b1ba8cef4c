#include "figure/svg.h"

#include "figure/ink.h"

#include <cmath>
#include <cstdio>
#include <set>

namespace relievo {

namespace {

std::string number(double v) {
    const double rounded = std::round(v * 100) / 100;
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", rounded == 0 ? 0.0 : rounded);  // never "-0"
    return text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            default: out += c;
        }
    }
    return out;
}

std::string colour(Rgb8 c) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", c[0], c[1], c[2]);
    return text;
}

std::string id_of(Ink ink) { return std::string(ink_colour(ink).id); }

std::string points_of(const Path& path) {
    std::string text;
    for (const Vec2d p : path.points) {
        if (!text.empty()) text += ' ';
        text.append(number(p.x)).append(",").append(number(p.y));
    }
    return text;
}

std::string mark_text(const Path& path) {
    const std::string name = path.closed ? "polygon" : "polyline";
    std::string text = "<" + name + " class=\"";
    text.append(path.fill > 0 ? "f-" : "n");
    if (path.fill > 0) text.append(id_of(path.ink));
    if (path.width > 0) text.append(" s-").append(id_of(path.ink));
    text += "\" points=\"" + points_of(path) + "\"";
    if (path.fill > 0 && path.fill < 1) text += " fill-opacity=\"" + number(path.fill) + "\"";
    if (path.width > 0) text += " stroke-width=\"" + number(path.width) + "\"";
    if (path.width > 0 && path.opacity < 1) text += " stroke-opacity=\"" + number(path.opacity) + "\"";
    if (path.dashed) text += " stroke-dasharray=\"" + number(dash_length) + " " + number(dash_gap) + "\"";
    return text + "/>\n";
}

std::string mark_text(const Dot& dot) {
    const std::string classes = dot.hollow ? "f-paper s-" + id_of(dot.ink) : "f-" + id_of(dot.ink) + " s-paper";
    return "<circle class=\"" + classes + "\" cx=\"" + number(dot.centre.x) + "\" cy=\"" + number(dot.centre.y) + "\" r=\"" + number(dot.radius) +
           "\" stroke-width=\"" + number(dot.width) + "\"/>\n";
}

std::string mark_text(const Label& label) {
    std::string text = "<text class=\"f-" + id_of(label.ink) + (label.bold ? " b" : "") + "\" x=\"" + number(label.at.x) + "\" y=\"" + number(label.at.y) +
                       "\" font-size=\"" + number(label.size) + "\"";
    if (label.anchor == Anchor::middle) text += " text-anchor=\"middle\"";
    if (label.anchor == Anchor::end) text += " text-anchor=\"end\"";
    return text + ">" + escaped(label.text) + "</text>\n";
}

std::set<Ink> inks_of(const Drawing& drawing) {
    std::set<Ink> inks{Ink::paper};
    for (const Mark& mark : drawing.marks) inks.insert(std::visit([](const auto& m) { return m.ink; }, mark));
    return inks;
}

std::string colours(const std::set<Ink>& inks, bool dark) {
    std::string text;
    for (const Ink i : inks) {
        const InkColour& ink = ink_colour(i);
        const std::string c = colour(dark ? ink.dark : ink.light);
        text += ".f-" + std::string(ink.id) + "{fill:" + c + "}.s-" + std::string(ink.id) + "{stroke:" + c + "}";
    }
    return text;
}

}  // namespace

std::string svg_text(const Drawing& drawing, Paper paper) {
    const std::set<Ink> inks = inks_of(drawing);
    const std::string w = number(drawing.width), h = number(drawing.height);
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + " " + h +
                       "\" role=\"img\">\n<title>" + escaped(drawing.title) + "</title>\n<desc>" + escaped(drawing.description) + "</desc>\n<style>" +
                       // Wide common fonts first: labels were placed with the metrics of DejaVu Sans, and Verdana has nearly the same.
                       "text{font-family:'DejaVu Sans',Verdana,'Segoe UI',sans-serif}.b{font-weight:bold}.n{fill:none}" +
                       "polyline,polygon{stroke-linecap:round;stroke-linejoin:round}" + colours(inks, paper == Paper::dark);
    if (paper == Paper::either) text += "@media (prefers-color-scheme:dark){" + colours(inks, true) + "}";
    text += "</style>\n<rect class=\"f-paper\" width=\"" + w + "\" height=\"" + h + "\"/>\n";
    for (const Mark& mark : drawing.marks) text += std::visit([](const auto& m) { return mark_text(m); }, mark);
    return text + "</svg>\n";
}

}  // namespace relievo
