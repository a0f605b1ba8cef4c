// Fur contract 1: pictures are what pictures are (finite, of light only where something is, covered by a share), the same for any number of
// threads, of skin alone where a coat is bald, and much the same on a finer mesh of the same surface.
#include "fur_contract/worn.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace relievo::fur_contract {
namespace {

class FurPictures : public EveryMode {};

TEST_P(FurPictures, have_finite_light_only_where_they_cover) {
    for (const char* id : {"rabbit", "sheep"}) {
        const FurFrames f = drawn(torus_mesh(32, 16), coat_of(id), 4);
        std::size_t covered = 0;
        for (std::size_t p = 0; p < f.coverage.texels.size(); ++p) {
            const float c = f.coverage.texels[p];
            ASSERT_TRUE(c >= 0 && c <= 1.0001f) << c;
            covered += c > 0.5f;
            for (std::size_t k = 0; k < 3; ++k) {
                const float light = f.colour.texels[p * 3 + k];
                // Premultiplied, and a display shows no more than 1. Stored in 8 bits of sRGB, where a step is 0.009 at most.
                ASSERT_TRUE(std::isfinite(light) && light >= 0 && light <= c + 0.01f) << light << " under " << c;
                ASSERT_TRUE(c > 0 || light == 0) << light;
            }
        }
        EXPECT_GT(covered, width * height / 8u) << id;
    }
}

TEST_P(FurPictures, do_not_depend_on_threads) {
    const Mesh mesh = made_up_scan({.faces = 3000});
    const FurFrames one = drawn(mesh, coat_of("fox"), 1, 1), four = drawn(mesh, coat_of("fox"), 1, 4);
    EXPECT_EQ(one.colour.texels, four.colour.texels);
    EXPECT_EQ(one.coverage.texels, four.coverage.texels);
}

// On a ball skin ends where the ball does, and nothing of what sets strands apart may show.
TEST_P(FurPictures, of_bald_coats_show_the_skin_alone) {
    const Mesh ball = made_up_scan({.faces = 8000, .relief = 0, .noise = 0});
    for (float Coat::*none : {&Coat::length, &Coat::strands}) {
        Coat bald = coat_of("rabbit");
        bald.*none = 0;
        Coat painted = bald;
        painted.tip_colour = {0.9f, 0.0f, 0.0f};
        painted.lock = painted.width = 0;
        const FurView view{.camera = camera_of(bald), .passes = 4};
        const FurFrames f = drawn(ball, bald, view.passes), g = drawn(ball, painted, view.passes);
        EXPECT_EQ(f.colour.texels, g.colour.texels);
        EXPECT_EQ(f.coverage.texels, g.coverage.texels);
        const double distance = length(view.camera.camera.eye), half = std::tan(view.camera.camera.fov_y_rad / 2);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double px = (2 * x + 1 - width) * half / height, py = (2 * y + 1 - height) * half / height;
                const double radius = distance * std::sin(std::atan(std::hypot(px, py)));
                ASSERT_TRUE(radius > 0.97 || f.coverage(x, y) == 1) << x << ' ' << y;
                ASSERT_TRUE(radius < 1.03 || f.coverage(x, y) == 0) << x << ' ' << y;
            }
    }
}

// The same surface in sixteen times the faces: each face in four, twice.
Mesh finer(Mesh mesh) {
    for (int round = 0; round < 2; ++round) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (is_new) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5f);
            return at->second;
        };
        std::vector<std::uint32_t> faces;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2], d = middle(a, b), e = middle(b, c), f = middle(c, a);
            faces.insert(faces.end(), {a, d, f, d, b, e, f, e, c, d, e, f});
        }
        mesh.indices = std::move(faces);
    }
    return mesh;
}

// Of the light of two pictures in squares of ten pixels, which single strands do not tell: the sum of differences over the sum.
double difference_of_looks(const FurFrames& a, const FurFrames& b) {
    constexpr int square = 10;
    double apart = 0, all = 0;
    for (int y = 0; y + square <= height; y += square)
        for (int x = 0; x + square <= width; x += square) {
            double sum_a = 0, sum_b = 0;
            for (int j = 0; j < square; ++j)
                for (int i = 0; i < square * 3; ++i) {
                    sum_a += a.colour.at(x, y + j)[i];
                    sum_b += b.colour.at(x, y + j)[i];
                }
            apart += std::abs(sum_a - sum_b);
            all += (sum_a + sum_b) / 2;
        }
    return apart / all;
}

// Stretched and sheared, so that no direction is as good as another: which way fur is combed must not hang on rounding.
Mesh leaning_torus() {
    Mesh mesh = torus_mesh(48, 24);
    for (Vec3f& p : mesh.positions) p = {1.3f * p.x + 0.4f * p.y, p.y, p.z};
    return mesh;
}

TEST_P(FurPictures, look_the_same_on_finer_meshes) {
    double most = 0;
    for (const Mesh& mesh : {leaning_torus(), made_up_scan({.faces = 6000})}) {
        const FurFrames coarse = drawn(mesh, coat_of("rabbit"), 4), fine = drawn(finer(mesh), coat_of("rabbit"), 4);
        const double difference = difference_of_looks(coarse, fine);
        EXPECT_LE(difference, mode().finer_mesh);
        most = std::max(most, difference);
    }
    EXPECT_GE(most, 0.4 * mode().finer_mesh) << "tighten the row's finer_mesh";
}

FOR_EVERY_MODE(FurPictures);

}  // namespace
}  // namespace relievo::fur_contract
