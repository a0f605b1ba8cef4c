#include "assets/material_file.h"

#include "assets/image_file.h"
#include "assets/material_sidecar.h"
#include "core/error.h"
#include "temporary_folder.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace relievo::test {

namespace {

constexpr int size = 64;

// Bumps with slopes in both directions, everywhere different.
float bump(double u, double v) {
    constexpr double tau = 2 * std::numbers::pi;
    return static_cast<float>(0.5 + 0.2 * std::sin(tau * 2 * u + std::sin(tau * v)) +
                              0.2 * std::cos(tau * 3 * v + 0.5 * std::sin(tau * 2 * u)));
}

ImageF height_picture(bool inverted = false) {
    ImageF image(size, size, 1);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            image(i, j) = inverted ? 1 - bump((i + 0.5) / size, (j + 0.5) / size) : bump((i + 0.5) / size, (j + 0.5) / size);
    return image;
}

ImageF normal_picture(bool green_down = false, double scale = 0.06) {
    ImageF image(size, size, 3);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const double u = (i + 0.5) / size, v = (j + 0.5) / size, e = 1e-3;
            const double x = -scale * (bump(u + e, v) - bump(u - e, v)) / (2 * e);
            const double y = -scale * (bump(u, v + e) - bump(u, v - e)) / (2 * e) * (green_down ? -1 : 1);
            const double n = std::sqrt(x * x + y * y + 1);
            image(i, j, 0) = static_cast<float>(0.5 + 0.5 * x / n);
            image(i, j, 1) = static_cast<float>(0.5 + 0.5 * y / n);
            image(i, j, 2) = static_cast<float>(0.5 + 0.5 / n);
        }
    return image;
}

}  // namespace

class MaterialFile : public InTemporaryFolder {
protected:
    void put_16(const std::string& name, const ImageF& image) const { write_png_16(folder / name, image, FirstRow::bottom); }
    void put_8(const std::string& name, int width, int height, int channels, std::uint8_t value = 128) const {
        write_png(folder / name, Image8(width, height, channels, value), FirstRow::bottom);
    }
    void put_exr(const std::string& name, const ImageF& image) const {
        write_exr(folder / name, std::vector<ExrChannel>{{"Y", &image, 0}}, FirstRow::bottom);
    }
    void put_jpeg(const std::string& name, const ImageF& image, int quality) const {
        ImageF flipped = image;
        for (int j = 0; j < image.height; ++j)
            std::copy_n(image.at(0, image.height - 1 - j), image.width * image.channels, flipped.at(0, j));
        const auto output = OIIO::ImageOutput::create("jpeg");
        OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
        spec["Compression"] = "jpeg:" + std::to_string(quality);
        ASSERT_TRUE(output->open((folder / name).string(), spec) &&
                    output->write_image(OIIO::TypeDesc::FLOAT, flipped.texels.data()) && output->close());
    }
    std::string refusal() const {
        return message_of<Error>([&] { load_material(folder); });
    }
    static bool noted(const Material& m, std::string_view part) {
        return std::any_of(m.notes.begin(), m.notes.end(), [&](const std::string& n) { return has(n, part); });
    }
    static std::string all(const Material& m) {
        std::string text;
        for (const std::string& n : m.notes) text += n + "\n";
        return text;
    }
};

TEST_F(MaterialFile, AllFourReadingsComeOutTheSame) {
    for (const bool jpeg : {false, true})
        for (const bool inverted : {false, true})
            for (const bool green_down : {false, true}) {
                const auto put_map = [&](const std::string& stem, const ImageF& image) {
                    jpeg ? put_jpeg(stem + ".jpg", image, 60) : put_16(stem + ".png", image);
                };
                for (const std::string& old : names()) std::filesystem::remove(folder / old);
                put_map("height", height_picture(inverted));
                put_map("normal", normal_picture(green_down));
                const Material m = load_material(folder);
                EXPECT_EQ(m.name, folder.filename().string());
                const float tolerance = jpeg ? 0.05f : 2e-5f;
                const float normal_tolerance = jpeg ? 0.15f : 1e-4f;
                const ImageF n = normal_picture();
                for (int j = 0; j < size; j += 7)
                    for (int i = 0; i < size; i += 5) {
                        EXPECT_NEAR(m.height.texels(i, j), bump((i + 0.5) / size, (j + 0.5) / size), tolerance);
                        for (int c = 0; c < 3; ++c) EXPECT_NEAR((*m.normal)(i, j, c), 2 * n(i, j, c) - 1, normal_tolerance);
                    }
                EXPECT_NEAR(m.height_scale, 0.06f, 0.004f);
                EXPECT_EQ(noted(m, "reads as depth (white is low) and was inverted"), inverted) << all(m);
                EXPECT_EQ(noted(m, "down (DirectX) and was flipped"), green_down) << all(m);
                EXPECT_TRUE(noted(m, "no colour map")) << all(m);
            }
}

TEST_F(MaterialFile, TheSidecarOverridesAndContradictionsAreNoted) {
    put_16("height.png", height_picture(true));
    put_16("normal.png", normal_picture(true));
    write_sidecar(folder / "material.toml", {.height_scale = 0.3f,
                                             .physical_size_m = 2,
                                             .zero_level = 0.5f,
                                             .white_is_high = true,
                                             .normal_y_up = true,
                                             .colour = {},
                                             .height = {},
                                             .normal = {}});
    const Material m = load_material(folder);
    EXPECT_NEAR(m.height.texels(3, 4), 1 - bump(3.5 / size, 4.5 / size), 2e-5f);
    EXPECT_NEAR((*m.normal)(3, 4, 1), 2 * normal_picture(true)(3, 4, 1) - 1, 1e-4f);
    EXPECT_EQ(m.height_scale, 0.3f);
    EXPECT_EQ(m.zero_level, 0.5f);
    EXPECT_EQ(m.physical_size_m, 2.0f);
    EXPECT_TRUE(noted(m, "material.toml says white is high, and is obeyed, but the maps say the opposite")) << all(m);
    EXPECT_TRUE(noted(m, "material.toml says green points up, and is obeyed, but the maps say the opposite")) << all(m);

    write_sidecar(folder / "material.toml", {.height_scale = {},
                                             .physical_size_m = {},
                                             .zero_level = {},
                                             .white_is_high = false,
                                             .normal_y_up = false,
                                             .colour = {},
                                             .height = {},
                                             .normal = {}});
    const Material agreed = load_material(folder);
    EXPECT_FALSE(noted(agreed, "opposite")) << all(agreed);
    EXPECT_NEAR(agreed.height.texels(3, 4), bump(3.5 / size, 4.5 / size), 2e-5f);
}

TEST_F(MaterialFile, NamesDecideOnlyWhereTheMapsCannot) {
    put_8("rock_depth.png", 8, 8, 1, 51);
    Material m = load_material(folder);
    EXPECT_NEAR(m.height.texels(0, 0), 0.8f, 1e-6f);
    EXPECT_TRUE(noted(m, "white taken as low, from the name rock_depth.png")) << all(m);

    std::filesystem::remove(folder / "rock_depth.png");
    put_16("rock_nor_dx.png", normal_picture(true));
    m = load_material(folder);
    EXPECT_TRUE(m.height.empty());
    EXPECT_NEAR((*m.normal)(3, 4, 1), 2 * normal_picture()(3, 4, 1) - 1, 1e-4f);
    EXPECT_TRUE(noted(m, "from the name rock_nor_dx.png")) << all(m);
    EXPECT_TRUE(noted(m, "height_scale 0.05 assumed")) << all(m);

    // A depth map that is none, by the evidence.
    put_16("rock_depth.png", height_picture());
    m = load_material(folder);
    EXPECT_NEAR(m.height.texels(3, 4), bump(3.5 / size, 4.5 / size), 2e-5f);
}

TEST_F(MaterialFile, UndecidedIsSaid) {
    put_16("height.png", height_picture());
    put_8("normal.png", size, size, 3);
    ImageF flat(size, size, 3, 0.5f);
    for (std::size_t i = 2; i < flat.texels.size(); i += 3) flat.texels[i] = 1;
    put_16("normal.png", flat);
    const Material m = load_material(folder);
    EXPECT_TRUE(noted(m, "white taken as high; the maps leave it undecided")) << all(m);
    EXPECT_TRUE(noted(m, "taken as up (OpenGL); the maps leave it undecided")) << all(m);
    EXPECT_TRUE(noted(m, "height_scale 0.05 assumed")) << all(m);
    EXPECT_TRUE(noted(m, "zero_level 1 assumed")) << all(m);
}

TEST_F(MaterialFile, WeakNormalsDoNotFlattenTheRelief) {
    put_16("height.png", height_picture());
    put_16("normal.png", normal_picture(false, 0.004));
    const Material m = load_material(folder);
    EXPECT_FLOAT_EQ(m.height_scale, 0.02f);
    EXPECT_TRUE(noted(m, "imply 0.004")) << all(m);
}

TEST_F(MaterialFile, ColoursAreExpandedToFourChannels) {
    put_16("height.png", height_picture());
    write_png(folder / "albedo.png", Image8(2, 2, 1, 77), FirstRow::bottom);
    EXPECT_EQ(load_material(folder).colour->texels,
              (std::vector<std::uint8_t>{77, 77, 77, 255, 77, 77, 77, 255, 77, 77, 77, 255, 77, 77, 77, 255}));
    Image8 two(1, 1, 2);
    two.texels = {9, 8};
    write_png(folder / "albedo.png", two, FirstRow::bottom);
    EXPECT_EQ(load_material(folder).colour->texels, (std::vector<std::uint8_t>{9, 9, 9, 8}));
    Image8 three(1, 1, 3);
    three.texels = {9, 8, 7};
    write_png(folder / "albedo.png", three, FirstRow::bottom);
    EXPECT_EQ(load_material(folder).colour->texels, (std::vector<std::uint8_t>{9, 8, 7, 255}));
}

TEST_F(MaterialFile, OddSizesWork) {
    put_8("height.png", 1, 1, 1, 255);
    EXPECT_EQ(load_material(folder).height.texels.texels, std::vector<float>{1.0f});
    put_8("height.png", 5, 3, 4, 51);  // alpha is no height
    put_8("color.png", 2, 7, 3);
    const Material m = load_material(folder);
    EXPECT_EQ(m.height.width(), 5);
    EXPECT_EQ(m.height.height(), 3);
    EXPECT_EQ(m.colour->height, 7);
    EXPECT_FLOAT_EQ(m.height.texels(4, 2), 0.2f);
    EXPECT_TRUE(noted(m, "flat")) << all(m);
    EXPECT_TRUE(noted(m, "there is no normal map to check it against")) << all(m);
}

TEST_F(MaterialFile, FloatHeightsAreScaledAndSaid) {
    ImageF image(2, 2, 1);
    image.texels = {-2, 6, 0, 2};
    put_exr("height.exr", image);
    const Material m = load_material(folder);
    EXPECT_EQ(m.height.texels.texels, (std::vector<float>{0, 1, 0.25f, 0.5f}));
    EXPECT_TRUE(noted(m, "heights run from -2 to 6; scaled to [0,1]")) << all(m);
    image.texels = {0.25f, 0.5f, 0.5f, 0.5f};  // within [0,1]: left alone
    put_exr("height.exr", image);
    EXPECT_EQ(load_material(folder).height.texels.texels, image.texels);
    image.texels = {7, 7, 7, 7};
    put_exr("height.exr", image);
    EXPECT_EQ(load_material(folder).height.texels.texels, (std::vector<float>(4, 0.5f)));
    image.texels = {-3e38f, 3e38f, 0, 0};
    put_exr("height.exr", image);
    EXPECT_TRUE(has(refusal(), "heights run from"));
}

TEST_F(MaterialFile, BrokenHeightsAreRefusedWithTheirPlace) {
    ImageF image(4, 3, 1);
    image(2, 1) = std::numeric_limits<float>::quiet_NaN();
    image(3, 2) = std::numeric_limits<float>::infinity();
    put_exr("height.exr", image);
    const std::string message = refusal();
    EXPECT_TRUE(has(message, "height.exr: 2 of its texels are NaN or infinite, one of them in column 2, row 1 from the top"))
        << message;
}

TEST_F(MaterialFile, AColourIsNoHeightAndNoNormal) {
    ImageF photo(size, size, 3);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            photo(i, j, 0) = 0.6f, photo(i, j, 1) = 0.4f * bump(i / 64.0, j / 64.0), photo(i, j, 2) = 0.2f;
    put_16("height.png", photo);
    EXPECT_TRUE(has(refusal(), "it is a colour picture")) << refusal();
    ImageF tinted = photo;  // grey with a breath of colour: read, and said
    for (std::size_t i = 0; i < tinted.texels.size(); ++i) tinted.texels[i] = 0.5f + (i % 3 == 0 ? 0.02f : 0.0f);
    put_16("height.png", tinted);
    EXPECT_TRUE(noted(load_material(folder), "slightly coloured"));
    for (float& x : photo.texels) x *= 50;
    write_exr(folder / "height.exr", std::vector<ExrChannel>{{"R", &photo, 0}, {"G", &photo, 1}, {"B", &photo, 2}},
              FirstRow::bottom);
    std::filesystem::remove(folder / "height.png");
    EXPECT_TRUE(has(refusal(), "it is a colour picture")) << refusal();
    std::filesystem::remove(folder / "height.exr");
    for (float& x : photo.texels) x /= 50;
    put_16("normal.png", photo);
    EXPECT_TRUE(has(refusal(), "no normals of a surface")) << refusal();
    put_16("normal.png", height_picture());
    EXPECT_TRUE(has(refusal(), "it is grey")) << refusal();
    put_8("normal.png", size, size, 3, 200);
    EXPECT_TRUE(has(refusal(), "it is grey")) << refusal();
    put_8("normal.png", size, size, 3, 0);
    EXPECT_TRUE(has(refusal(), "100 % of its texels are no normals")) << refusal();
}

TEST_F(MaterialFile, FoldersThatAreNoMaterial) {
    EXPECT_TRUE(has(refusal(), "there is no picture in it")) << refusal();
    put("readme.txt", "nothing to see");
    EXPECT_TRUE(has(refusal(), "there is no picture in it"));
    put_8("color.png", 4, 4, 3);
    put_8("photo.png", 4, 4, 3);
    EXPECT_TRUE(has(refusal(), "none of its pictures is a height or a normal map by its name: color.png, photo.png")) << refusal();
    EXPECT_TRUE(has(message_of<Error>([&] { load_material(folder / "none"); }), "there is no such folder"));
    EXPECT_TRUE(has(message_of<Error>([&] { load_material(folder / "color.png"); }), "it is a file, not a folder"));
    EXPECT_TRUE(has(message_of<Error>([&] { load_material(MaterialFiles{}); }), "neither height nor normal"));
    put("height.png", "");
    EXPECT_TRUE(has(refusal(), "height.png: the file is empty"));
    if (::geteuid() != 0) {
        std::filesystem::permissions(folder, std::filesystem::perms::none);
        EXPECT_TRUE(has(refusal(), "Permission denied"));
    }
}

TEST_F(MaterialFile, AmbiguousFolders) {
    put_8("a_height.png", 4, 4, 1);
    put_8("b_height.png", 4, 4, 1);
    EXPECT_TRUE(has(refusal(), "it has several height maps: a_height.png, b_height.png")) << refusal();
    put("material.toml", "[files]\nheight = \"b_height.png\"\n");
    std::vector<std::string> notes;
    EXPECT_EQ(find_material_files(folder, notes).height, folder / "b_height.png");
    put("material.toml", "[files]\nheight = \"c_height.png\"\n");
    EXPECT_TRUE(has(refusal(), "there is no such file"));
    std::filesystem::remove(folder / "material.toml");

    // A real height goes before a bump, the OpenGL normal before the DirectX one; of two colours the first by name.
    std::filesystem::remove(folder / "b_height.png");
    put_8("a_bump.png", 4, 4, 1);
    put_8("a_nor_dx.png", 4, 4, 3);
    put_8("a_nor_gl.png", 4, 4, 3);
    put_8("a_diff.png", 4, 4, 3);
    put_8("a_color.png", 4, 4, 3);
    put_8("a_rough.png", 4, 4, 1);
    const MaterialFiles files = find_material_files(folder, notes);
    EXPECT_EQ(files.height, folder / "a_height.png");
    EXPECT_EQ(files.normal, folder / "a_nor_gl.png");
    EXPECT_EQ(files.colour, folder / "a_color.png");
    EXPECT_EQ(notes, (std::vector<std::string>{"colour is a_color.png, not a_diff.png", "height is a_height.png, not a_bump.png",
                                               "normal is a_nor_gl.png, not a_nor_dx.png"}));
}

}  // namespace relievo::test
