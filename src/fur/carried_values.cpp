#include "fur/carried_values.h"

#include <cassert>

namespace relievo {

Mesh carrying(const Mesh& mesh, std::span<const float> lengths, std::span<const PaintedLean> painted) {
    assert((lengths.empty() || lengths.size() == mesh.positions.size()) && (painted.empty() || painted.size() == mesh.positions.size()));
    Mesh carrier = mesh;
    if (lengths.empty() && painted.empty()) return carrier;
    carrier.uvs.clear();
    carrier.colours.clear();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        carrier.uvs.emplace_back(lengths.empty() ? 1.0f : lengths[v], painted.empty() ? 0.0f : painted[v].weight);
        if (!painted.empty()) carrier.colours.push_back(painted[v].weighted);
    }
    return carrier;
}

SkinPaint taken_off(Mesh& mesh, bool lengths, bool painted) {
    SkinPaint values;
    if (!lengths && !painted) return values;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (lengths) values.lengths.push_back(mesh.uvs[v].x);
        if (painted) values.painted.push_back({mesh.colours[v], mesh.uvs[v].y});
    }
    mesh.uvs.clear();
    mesh.colours.clear();
    return values;
}

}  // namespace relievo
