// From the properties of a PLY's vertices to the lists of a mesh.
#pragma once

#include "core/mesh.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/ply_header.h"

namespace relievo::ply {

// Which property of a vertex goes where.
enum Target : int { x, y, z, nx, ny, nz, red, green, blue, u, v, none };

inline Target target_named(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Target>, 23> names = {{{"x", x}, {"y", y}, {"z", z}, {"nx", nx}, {"ny", ny}, {"nz", nz},
        {"normal_x", nx}, {"normal_y", ny}, {"normal_z", nz}, {"red", red}, {"green", green}, {"blue", blue}, {"r", red}, {"g", green}, {"b", blue},
        {"diffuse_red", red}, {"diffuse_green", green}, {"diffuse_blue", blue}, {"u", u}, {"v", v}, {"s", u}, {"t", v}, {"texture_u", u}}};
    for (const auto& [known, target] : names)
        if (known == name) return target;
    return name == "texture_v" ? v : none;
}

// Values of vertices into the lists of a mesh.
class VertexSink {
public:
    VertexSink(const Element& element, Mesh& mesh) : mesh_(mesh) {
        std::array<bool, none> given{};
        for (const Property& property : element.properties) {
            Target target = property.count ? none : target_named(property.name);
            if (target != none && given[target]) target = none;  // the first of that meaning counts
            if (target != none) given[target] = true;
            targets_.push_back(target);
            // Whole numbers are shares of the type's largest value; real ones are shares already.
            const bool colour = target >= red && target <= blue;
            scales_.push_back(colour && property.type == Type::u8 ? 1.0f / 255 : colour && property.type == Type::u16 ? 1.0f / 65535 : 1.0f);
        }
        complete_ = given[x] && given[y] && given[z];
        const std::size_t n = complete_ ? static_cast<std::size_t>(element.count) : 0;
        mesh_.positions.resize(n);
        if (given[nx] && given[ny] && given[nz]) mesh_.normals.resize(n);
        if (given[red] && given[green] && given[blue]) mesh_.colours.resize(n);
        if (given[u] && given[v]) mesh_.uvs.resize(n);
        for (Target& target : targets_)
            if ((target >= nx && target <= nz && mesh_.normals.empty()) || (target >= red && target <= blue && mesh_.colours.empty()) ||
                ((target == u || target == v) && mesh_.uvs.empty()))
                target = none;
    }

    bool complete() const { return complete_; }
    Target target(std::size_t property) const { return targets_[property]; }

    void put(std::size_t vertex, std::size_t property, float value) const {
        switch (targets_[property]) {
            case x: mesh_.positions[vertex].x = value; break;
            case y: mesh_.positions[vertex].y = value; break;
            case z: mesh_.positions[vertex].z = value; break;
            case nx: mesh_.normals[vertex].x = value; break;
            case ny: mesh_.normals[vertex].y = value; break;
            case nz: mesh_.normals[vertex].z = value; break;
            // Divided, not multiplied: 255/255 has to be 1.
            case red: mesh_.colours[vertex].x = scaled(value, property); break;
            case green: mesh_.colours[vertex].y = scaled(value, property); break;
            case blue: mesh_.colours[vertex].z = scaled(value, property); break;
            case u: mesh_.uvs[vertex].x = value; break;
            case v: mesh_.uvs[vertex].y = value; break;
            case none: break;
        }
    }

private:
    float scaled(float value, std::size_t property) const { return scales_[property] == 1.0f ? value : value / std::round(1.0f / scales_[property]); }

    Mesh& mesh_;
    std::vector<Target> targets_;
    std::vector<float> scales_;
    bool complete_ = false;
};

}  // namespace relievo::ply
