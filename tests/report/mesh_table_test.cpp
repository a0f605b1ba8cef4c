#include "report/mesh_table.h"

#include "core/error.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(MeshTable, JsonComesBackWhole) {
    MeshTable table{"1.2", "2026-01-01T00:00:00Z", "a device", 2, {}, {"x.obj: \"no\" mesh"}};
    MeshRow row{.file = "bunny.obj", .input = "12 bytes", .normals = "angle", .index = true, .order = "lin-yu", .faces = 69451, .sphere_radius = 0.1};
    row.frames_per_second = 12.5;
    table.rows = {row, MeshRow{.file = "b,\"c\".obj"}};
    const std::string json = mesh_table_json(table);
    EXPECT_EQ(mesh_table_json(parse_mesh_table(json, "here")), json);
    const MeshTable back = parse_mesh_table(json, "here");
    EXPECT_EQ(back.rows[0].frames_per_second, 12.5);
    EXPECT_FALSE(back.rows[0].vertex_invocations.has_value());
    EXPECT_EQ(back.rows[0].faces, 69451u);
    EXPECT_EQ(back.rows[1].file, "b,\"c\".obj");
    EXPECT_NE(mesh_table_csv(table).find("\"b,\"\"c\"\".obj\""), std::string::npos);
    EXPECT_THROW(parse_mesh_table("{}", "here"), Error);
    EXPECT_THROW(parse_mesh_table(json.substr(0, json.size() / 2), "here"), Error);
    EXPECT_THROW(parse_mesh_table(R"({"version":1})", "here"), Error);
}

TEST(MeshTable, PageShowsOurFigureBesideThePublishedOne) {
    MeshTable table;
    MeshRow row{.file = "<dragon>.ply", .normals = "distinct", .index = true, .order = "meshopt", .faces = 871414, .normals_ms = 12.3};
    table.rows = {row};
    const std::string page = mesh_table_page(table);
    EXPECT_NE(page.find("&lt;dragon&gt;.ply <i>Dragon 0</i>"), std::string::npos);
    EXPECT_NE(page.find("<td>0.0123</td><td class=old>86.396</td>"), std::string::npos);
    EXPECT_EQ(page.find("<dragon>"), std::string::npos);
}

TEST(MeshTable, PublishedFiguresAgreeWithThemselves) {
    EXPECT_EQ(published_mesh(5), nullptr);
    for (const std::size_t faces : {12u, 384u, 69451u, 871414u, 1087716u}) {
        const PublishedMesh* p = published_mesh(faces);
        ASSERT_NE(p, nullptr);
        EXPECT_NEAR(p->kilobytes_before, static_cast<double>(faces) * 72 / 1024, 0.001);
        // The other rows do too, but for the bunny's 208.436 KB at 16,301 faces, which by the rest of its table is 286.436.
        const std::size_t bytes = p->vertices_after * 24 + faces * 3 * (p->vertices_after < 65536 ? 2 : 4);
        EXPECT_NEAR(p->kilobytes_after, static_cast<double>(bytes) / 1024, 0.001) << p->name;
    }
}

}  // namespace
}  // namespace relievo
