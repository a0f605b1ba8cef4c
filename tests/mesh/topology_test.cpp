#include "mesh/topology.h"

#include "mesh/made_up_scan.h"
#include "mesh/repair.h"
#include "mesh/shapes.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

void flip(Mesh& mesh, std::size_t face) { std::swap(mesh.indices[face * 3 + 1], mesh.indices[face * 3 + 2]); }

Mesh moebius_band() {
    Mesh mesh;
    constexpr std::uint32_t n = 8;
    for (std::uint32_t i = 0; i < n; ++i) {
        const float a = static_cast<float>(i);
        mesh.positions.emplace_back(a, 0.0f, 0.0f);
        mesh.positions.emplace_back(a, 1.0f, 0.0f);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n;
        const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
    return mesh;
}

TEST(Topology, Cube) {
    for (const Mesh& mesh : {test::cube(), test::as_list(test::cube())}) {
        const Topology t = topology(mesh);
        EXPECT_EQ(t.distinct_positions, 8u);
        EXPECT_EQ(t.duplicate_vertices, mesh.positions.size() - 8);
        EXPECT_EQ(t.faces, 12u);
        EXPECT_EQ(t.edges, 18u);
        EXPECT_EQ(t.euler, 2);
        EXPECT_EQ(t.genus, 0);
        EXPECT_EQ(t.components, 1u);
        EXPECT_TRUE(t.closed && t.oriented);
        EXPECT_EQ(t.holes + t.boundary_edges + t.non_manifold_edges + t.non_manifold_vertices + t.flipped_edges + t.degenerate_faces +
                      t.duplicate_faces + t.unreferenced_vertices,
                  0u);
    }
}

TEST(Topology, HandlesHolesAndPieces) {
    EXPECT_EQ(topology(test::torus(7, 5)).genus, 1);
    const Mesh two = test::joined(test::torus(7, 5), test::moved(test::cube(), {9, 0, 0}));
    EXPECT_EQ(topology(two).components, 2u);
    EXPECT_EQ(topology(two).genus, 1);
    EXPECT_EQ(topology(two).euler, 2);

    Mesh holed = test::torus(12, 9);
    holed.indices.erase(holed.indices.begin() + 300, holed.indices.begin() + 303);
    holed.indices.erase(holed.indices.begin(), holed.indices.begin() + 3);
    const Topology t = topology(holed);
    EXPECT_EQ(t.boundary_edges, 6u);
    EXPECT_EQ(t.holes, 2u);
    EXPECT_EQ(t.genus, 1);
    EXPECT_FALSE(t.closed);
    EXPECT_TRUE(t.oriented);

    const Topology sheet = topology(test::grid(5));
    EXPECT_EQ(sheet.holes, 1u);
    EXPECT_EQ(sheet.boundary_edges, 20u);
    EXPECT_EQ(sheet.genus, 0);
    EXPECT_EQ(sheet.euler, 1);
}

TEST(Topology, FaultsAreCounted) {
    Mesh flipped = test::sphere(2);
    flip(flipped, 5);
    EXPECT_EQ(topology(flipped).flipped_edges, 3u);
    EXPECT_FALSE(topology(flipped).oriented);
    EXPECT_FALSE(topology(flipped).genus.has_value());

    // A third wing on one edge of the cube.
    Mesh wing = test::cube();
    wing.positions.emplace_back(5.0f, 5.0f, 5.0f);
    wing.indices.insert(wing.indices.end(), {0, 2, 8});
    const Topology t = topology(wing);
    EXPECT_EQ(t.non_manifold_edges, 1u);
    EXPECT_EQ(t.boundary_edges, 2u);
    EXPECT_EQ(t.components, 1u);

    // Two tetrahedra tip to tip: all edges are fine, the tip is not.
    const Mesh tips = test::joined(test::tetrahedron(), test::moved(test::tetrahedron(), {0, 0, 0}));
    EXPECT_EQ(topology(tips).duplicate_faces, 4u);
    Mesh point = test::joined(test::tetrahedron(), test::moved(test::tetrahedron(), {2, 2, 0}));
    const Topology p = topology(point);
    EXPECT_EQ(p.distinct_positions, 7u);
    EXPECT_EQ(p.non_manifold_vertices, 1u);
    EXPECT_EQ(p.non_manifold_edges, 0u);
    EXPECT_EQ(p.components, 2u);
    EXPECT_TRUE(p.closed);

    Mesh bad = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {2, 0, 0}, {3, 3, 3}}, {0, 1, 2, 0, 1, 3, 0, 1, 4, 2, 0, 1, 1, 0, 2});
    const Topology b = topology(bad);
    EXPECT_EQ(b.degenerate_faces, 2u);  // one collapsed, one on a line
    EXPECT_EQ(b.duplicate_faces, 2u);   // turned round and turned over
    EXPECT_EQ(b.unreferenced_vertices, 1u);
    EXPECT_EQ(b.duplicate_vertices, 1u);

    const Topology none = topology({});
    EXPECT_FALSE(none.euler.has_value());
    EXPECT_FALSE(none.closed);
}

TEST(Topology, OneSidedSurfaces) {
    const Topology t = topology(moebius_band());
    EXPECT_EQ(t.holes, 1u);
    EXPECT_GT(t.flipped_edges, 0u);
    const RepairedMesh r = repaired(moebius_band());
    EXPECT_EQ(r.changed.faces_turned, 0u) << "turning cannot help";
}

TEST(Repair, LeavesASoundMeshAlone) {
    const Mesh scan = made_up_scan({.faces = 5000});
    const RepairedMesh r = repaired(scan);
    EXPECT_EQ(r.mesh.indices, scan.indices);
    EXPECT_EQ(r.mesh.positions, scan.positions);
    EXPECT_TRUE(r.mesh.notes.empty());
}

TEST(Repair, SaysWhatItChanged) {
    Mesh bad = test::as_list(test::sphere(3));
    const std::vector<std::array<float, 9>> good = test::face_set(bad);
    for (const std::size_t f : {3u, 77u, 78u, 400u}) flip(bad, f);
    bad.indices.insert(bad.indices.end(), {0, 1, 2, 5, 4, 3});  // the first two faces again, the second turned over
    bad.positions.push_back(bad.positions[0]);
    bad.indices.insert(bad.indices.end(), {0, 1, static_cast<std::uint32_t>(bad.positions.size() - 1)});  // corners at one place
    bad.positions.emplace_back(8.0f, 8.0f, 8.0f);                                                        // used by nobody
    const RepairedMesh r = repaired(bad);
    EXPECT_EQ(r.changed.faces_turned, 4u);
    EXPECT_EQ(r.changed.faces_repeated, 2u);
    EXPECT_EQ(r.changed.faces_collapsed, 1u);
    EXPECT_EQ(r.changed.pieces_turned_out, 0u);
    EXPECT_EQ(r.changed.vertices_unreferenced, 2u);
    EXPECT_EQ(r.changed.vertices_merged, 512u * 3 - 258);
    EXPECT_EQ(test::face_set(r.mesh), good);
    EXPECT_EQ(r.mesh.notes.size(), 5u);
    const Topology t = topology(r.mesh);
    EXPECT_TRUE(t.closed && t.oriented);
    EXPECT_EQ(t.duplicate_vertices + t.unreferenced_vertices + t.duplicate_faces + t.degenerate_faces, 0u);
    EXPECT_TRUE(repaired(r.mesh).mesh.notes.size() == r.mesh.notes.size()) << "a second time there is nothing to do";
}

TEST(Repair, TurnsClosedPiecesOutAndFollowsTheMajorityOnOpenOnes) {
    Mesh inside_out = test::moved(test::cube(), {40, 0, 0});  // far from the origin: its volume, not its normals, decides
    for (std::size_t f = 0; f < 12; ++f) flip(inside_out, f);
    const RepairedMesh r = repaired(inside_out);
    EXPECT_EQ(r.changed.faces_turned, 12u);
    EXPECT_EQ(r.changed.pieces_turned_out, 1u);
    EXPECT_EQ(test::face_set(r.mesh), test::face_set(test::moved(test::cube(), {40, 0, 0})));

    Mesh sheet = test::grid(6);
    const auto wanted = test::face_set(sheet);
    for (const std::size_t f : {0u, 1u, 2u, 30u, 71u}) flip(sheet, f);
    EXPECT_EQ(test::face_set(repaired(sheet).mesh), wanted);
}

TEST(MadeUpScan, IsClosedOutwardsAndOfItsSize) {
    for (const std::uint32_t faces : {8u, 100u, 20000u}) {
        const Mesh scan = made_up_scan({.faces = faces});
        const Topology t = topology(scan);
        EXPECT_TRUE(t.closed && t.oriented) << faces;
        EXPECT_EQ(t.genus, 0);
        EXPECT_EQ(t.duplicate_vertices + t.unreferenced_vertices + t.degenerate_faces + t.duplicate_faces + t.non_manifold_vertices, 0u);
        if (faces > 1000) {
            EXPECT_NEAR(static_cast<double>(scan.faces()), faces, 0.03 * faces);
        }
        double volume = 0;
        for (std::size_t i = 0; i < scan.indices.size(); i += 3)
            volume += dot(Vec3d(scan.positions[scan.indices[i]]), cross(Vec3d(scan.positions[scan.indices[i + 1]]), Vec3d(scan.positions[scan.indices[i + 2]]))) / 6;
        EXPECT_GT(volume, 0.5);
    }
    EXPECT_EQ(made_up_scan({.faces = 9000, .threads = 1}).positions, made_up_scan({.faces = 9000, .threads = 4}).positions);
    EXPECT_FALSE(made_up_scan({.faces = 9000, .seed = 2}).positions == made_up_scan({.faces = 9000}).positions);
}

}  // namespace
}  // namespace relievo
