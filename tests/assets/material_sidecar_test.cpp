#include "assets/material_sidecar.h"

#include "core/error.h"
#include "temporary_folder.h"

namespace relievo::test {

class Sidecar : public InTemporaryFolder {
protected:
    std::string refusal(std::string_view text) {
        return message_of<Error>([&] { read_sidecar(put("material.toml", text)); });
    }
};

TEST_F(Sidecar, ReadsEveryKey) {
    const MaterialSidecar s = read_sidecar(put("material.toml", R"(height_scale = 0.08
physical_size_m = 2   # whole numbers are numbers
zero_level = 0.25
white_is_high = false
normal_y = "down"
[files]
colour = "a.png"
height = "b.exr"
normal = "c.tga"
)"));
    EXPECT_EQ(s.height_scale, 0.08f);
    EXPECT_EQ(s.physical_size_m, 2.0f);
    EXPECT_EQ(s.zero_level, 0.25f);
    EXPECT_EQ(s.white_is_high, false);
    EXPECT_EQ(s.normal_y_up, false);
    EXPECT_EQ(s.colour, "a.png");
    EXPECT_EQ(s.height, "b.exr");
    EXPECT_EQ(s.normal, "c.tga");
}

TEST_F(Sidecar, EmptyMeansNothingIsSaid) {
    const MaterialSidecar s = read_sidecar(put("material.toml", ""));
    EXPECT_FALSE(s.height_scale || s.physical_size_m || s.zero_level || s.white_is_high || s.normal_y_up || s.colour || s.height ||
                 s.normal);
}

TEST_F(Sidecar, WrittenReadsBackTheSame) {
    const MaterialSidecar s{.height_scale = 1.0f / 3,
                            .physical_size_m = 1,
                            .zero_level = 0.1f,
                            .white_is_high = true,
                            .normal_y_up = true,
                            .colour = std::nullopt,
                            .height = "odd \"name\" \\ é\t.png",
                            .normal = std::nullopt};
    write_sidecar(folder / "material.toml", s);
    const MaterialSidecar r = read_sidecar(folder / "material.toml");
    EXPECT_EQ(r.height_scale, s.height_scale);
    EXPECT_EQ(r.physical_size_m, s.physical_size_m);
    EXPECT_EQ(r.zero_level, s.zero_level);
    EXPECT_EQ(r.white_is_high, s.white_is_high);
    EXPECT_EQ(r.normal_y_up, s.normal_y_up);
    EXPECT_EQ(r.height, s.height);
    EXPECT_FALSE(r.colour || r.normal);
}

TEST_F(Sidecar, MistakesAreNamedWithTheirLine) {
    EXPECT_TRUE(has(refusal("\nheight_scal = 0.1"), "line 2: unknown key \"height_scal\"\n  did you mean \"height_scale\"?"));
    EXPECT_TRUE(has(refusal("[files]\ncolor = \"a.png\""), "did you mean \"colour\"?"));
    const std::string far = refusal("frobnicate = 1");
    EXPECT_TRUE(has(far, "Known keys are height_scale")) << far;
    EXPECT_FALSE(has(far, "did you mean")) << far;
    EXPECT_TRUE(has(refusal("height_scale = \"0.1\""), "line 1: height_scale must be a number"));
    EXPECT_TRUE(has(refusal("height_scale = true"), "must be a number"));
    EXPECT_TRUE(has(refusal("white_is_high = 1"), "must be true or false"));
    EXPECT_TRUE(has(refusal("normal_y = 1"), "must be \"up\" or \"down\""));
    EXPECT_TRUE(has(refusal("normal_y = \"left\""), "not \"left\""));
    EXPECT_TRUE(has(refusal("files = \"a\""), "must be a table"));
    EXPECT_TRUE(has(refusal("height_scale = 0"), "out of range"));
    EXPECT_TRUE(has(refusal("height_scale = 1.5"), "at most 1"));
    EXPECT_TRUE(has(refusal("height_scale = nan"), "out of range"));
    EXPECT_TRUE(has(refusal("zero_level = -0.1"), "at least 0"));
    EXPECT_TRUE(has(refusal("physical_size_m = inf"), "out of range"));
    EXPECT_TRUE(has(refusal("zero_level = 1\nzero_level = 0"), "line 2"));
    EXPECT_TRUE(has(refusal("height_scale 0.1"), "line 1"));
    EXPECT_TRUE(has(refusal(std::string_view("\0\x01\xff", 3)), "line 1"));
    EXPECT_TRUE(has(message_of<Error>([&] { read_sidecar(folder / "none.toml"); }), "cannot be opened"));
    EXPECT_TRUE(has(message_of<Error>([&] { read_sidecar(folder); }), "cannot be opened"));
}

}  // namespace relievo::test
