// Fur contract 2: what is hardly a mesh gets fur, or a refusal that names it; never a crash, never a picture of nothing.
#include "fur_contract/worn.h"

#include <cmath>
#include <limits>

namespace relievo::fur_contract {
namespace {

class FurOnBadMeshes : public EveryMode {
protected:
    // Fur, and it is to be seen; or a refusal with a reason.
    void grows_or_refuses(Mesh mesh, const char* what) {
        mesh.name = what;
        try {
            const FurFrames f = drawn(mesh, coat_of("rabbit"), 1);
            EXPECT_GT(std::ranges::count_if(f.coverage.texels, [](float c) { return c > 0.5f; }), 50) << what;
            for (const float c : f.colour.texels) ASSERT_TRUE(std::isfinite(c)) << what;
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
        }
    }
    void refuses(Mesh mesh, const char* what) {
        mesh.name = what;
        try {
            drawn(mesh, coat_of("rabbit"), 1);
            ADD_FAILURE() << "fur grew on " << what;
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
        }
    }
};

Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{-1, -0.5f, 0}, {1, -0.5f, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

TEST_P(FurOnBadMeshes, grows_or_says_why_not) {
    grows_or_refuses(triangle(), "single triangle");

    Mesh open = torus_mesh(32, 16);
    open.indices.resize(open.indices.size() / 2 / 3 * 3);
    grows_or_refuses(std::move(open), "open torus");

    Mesh degenerate = torus_mesh(32, 16);
    for (std::uint32_t f = 0; f < 200; ++f) {
        const std::uint32_t v = f * 2;
        degenerate.indices.insert(degenerate.indices.end(), {v, v, v + 1, v, v, v});
    }
    grows_or_refuses(std::move(degenerate), "collapsed faces");

    Mesh wrong = torus_mesh(32, 16);
    wrong.normals.assign(wrong.positions.size(), Vec3f(0, 0, 0));
    grows_or_refuses(std::move(wrong), "normals of zero");

    Mesh twice = torus_mesh(32, 16);
    const std::vector<std::uint32_t> faces = twice.indices;
    twice.indices.insert(twice.indices.end(), faces.begin(), faces.end());
    grows_or_refuses(std::move(twice), "every face twice");

    Mesh far = torus_mesh(32, 16);
    for (Vec3f& p : far.positions) p = p * 1e-3f + Vec3f(500, 0, 0);
    grows_or_refuses(std::move(far), "small and far away");

    Mesh fin = torus_mesh(32, 16);  // an edge of three faces, and a point that no face uses
    fin.positions.emplace_back(0.0f, 2.0f, 0.0f);
    fin.positions.emplace_back(9.0f, 9.0f, 9.0f);
    fin.indices.insert(fin.indices.end(), {0, 1, 512});
    grows_or_refuses(std::move(fin), "a fin");
}

TEST_P(FurOnBadMeshes, refuses_what_has_no_surface) {
    refuses({}, "nothing");
    Mesh needle = triangle();
    needle.positions[2] = {0, -0.5f, 0};
    refuses(std::move(needle), "a needle");
    Mesh point = triangle();
    for (Vec3f& p : point.positions) p = {1, 1, 1};
    refuses(std::move(point), "a point");
}

FOR_EVERY_MODE(FurOnBadMeshes);

}  // namespace
}  // namespace relievo::fur_contract
