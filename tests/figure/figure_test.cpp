// Line drawings: what is cut off, what is covered, what can be read.
#include "figure/clip.h"
#include "figure/font.h"
#include "figure/ink.h"
#include "figure/raster.h"
#include "figure/svg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace relievo {
namespace {

double area_of(const std::vector<Vec2d>& p) {
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec2d a = p[i], b = p[(i + 1) % p.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
}

// Ink on white paper, as a number of whole pixels.
double inked(const Drawing& drawing, double scale) {
    const Image8 picture = raster(drawing, Paper::light, scale);
    const Rgb8 ink = ink_colour(Ink::text).light;
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) sum += (255.0 - picture(x, y, 0)) / (255.0 - ink[0]);
    return sum;
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 8) / 16777216.0; }

private:
    std::mt19937 engine_;
};

TEST(Raster, AreasAreCoveredExactly) {
    Random random(3);
    for (int i = 0; i < 60; ++i) {
        // A triangle anywhere, cut at the picture's edge by the clipper: its area is known.
        const std::vector<Vec2d> triangle{{random(-20, 70), random(-20, 60)}, {random(-20, 70), random(-20, 60)}, {random(-20, 70), random(-20, 60)}};
        Drawing drawing{.width = 50, .height = 40};
        drawing.marks.push_back(Path{.points = triangle, .closed = true, .ink = Ink::text, .fill = 1});
        const double expected = area_of(clipped_area(triangle, {0, 0, 50, 40}));
        // Each pixel is rounded to one of 224 greys.
        EXPECT_NEAR(inked(drawing, 1), expected, 0.02 * expected / 10 + 0.6) << i;
        EXPECT_NEAR(inked(drawing, 2), 4 * expected, 0.02 * expected + 1.2) << i;
    }
}

TEST(Raster, LinesAreAsWideAsTheySay) {
    for (const double width : {0.5, 1.0, 3.0, 8.0}) {
        Drawing drawing{.width = 120, .height = 60};
        drawing.marks.push_back(Path{.points = {{20, 15.3}, {100, 44.8}}, .ink = Ink::text, .width = width});
        const double length = std::hypot(80, 29.5);
        EXPECT_NEAR(inked(drawing, 1), length * width + 3.14159265 * width * width / 4, 0.04 * length * width + 1) << width;
        // A joint is not counted twice.
        Drawing bent = drawing;
        std::get<Path>(bent.marks[0]).points = {{20, 15.3}, {60, 30.05}, {100, 44.8}};
        EXPECT_NEAR(inked(bent, 1), inked(drawing, 1), 1) << width;
        std::get<Path>(drawing.marks[0]).dashed = true;
        if (width < dash_gap) {
            EXPECT_LT(inked(drawing, 1), 0.9 * length * width + 3) << width;
        }
    }
}

TEST(Raster, MarksFarOutsideCostNothingAndShowNothing) {
    Drawing drawing{.width = 30, .height = 20};
    drawing.marks.push_back(Path{.points = {{-1e9, 5}, {1e9, 5e8}}, .ink = Ink::text, .width = 2});
    drawing.marks.push_back(Dot{.centre = {1e7, -1e7}, .ink = Ink::text});
    drawing.marks.push_back(Label{.at = {-5000, 10}, .text = "nobody reads this"});
    EXPECT_LT(inked(drawing, 1), 70);  // the line alone crosses
}

TEST(Raster, HolesOfLettersStayOpen) {
    Drawing drawing{.width = 60, .height = 60};
    drawing.marks.push_back(Label{.at = {6, 54}, .text = "O", .size = 60});
    const Image8 picture = raster(drawing, Paper::light, 1);
    EXPECT_EQ(picture(6 + static_cast<int>(text_width("O", 60, false) / 2), 32, 0), 255);
    EXPECT_GT(inked(drawing, 1), 300);
}

TEST(Clip, LinesKeepTheirInside) {
    Random random(5);
    const Rect room{10, 10, 40, 30};
    for (int i = 0; i < 200; ++i) {
        std::vector<Vec2d> line;
        for (int k = 0; k < 6; ++k) line.push_back({random(0, 50), random(0, 40)});
        // Points along the line, each tested by itself.
        double inside = 0, kept = 0;
        for (std::size_t k = 0; k + 1 < line.size(); ++k)
            for (int s = 0; s < 400; ++s)
                if (room.contains(line[k] + (line[k + 1] - line[k]) * ((s + 0.5) / 400))) inside += length(line[k + 1] - line[k]) / 400;
        for (const auto& part : clipped_line(line, room)) {
            ASSERT_GE(part.size(), 2u);
            for (std::size_t k = 0; k + 1 < part.size(); ++k) kept += length(part[k + 1] - part[k]);
            for (const Vec2d p : part) EXPECT_TRUE(p.x > 10 - 1e-9 && p.x < 40 + 1e-9 && p.y > 10 - 1e-9 && p.y < 30 + 1e-9);
        }
        EXPECT_NEAR(kept, inside, 0.5);
    }
    EXPECT_TRUE(clipped_area({{0, 0}, {5, 0}, {0, 5}}, room).empty());
    EXPECT_NEAR(area_of(clipped_area({{0, 0}, {100, 0}, {100, 100}, {0, 100}}, room)), 600, 1e-9);
}

TEST(Font, WidthsAddUpAndOutlinesStayInside) {
    const std::string_view words = "First hit at 0.25 texels";
    double sum = 0;
    for (const char& c : words) sum += text_width({&c, 1}, 13, false);
    EXPECT_NEAR(text_width(words, 13, false), sum, 1e-6);
    EXPECT_NEAR(text_width(words, 26, false), 2 * text_width(words, 13, false), 1e-6);
    EXPECT_GT(text_width(words, 13, true), text_width(words, 13, false));
    EXPECT_EQ(text_width("", 13, false), 0);
    // One letter of two bytes is one letter; a torn one does not run away.
    EXPECT_NEAR(text_width("\u00e9", 13, false), text_width("e", 13, false), 1e-6);
    EXPECT_LT(text_width("\xe2\x82", 13, false), 30);
    for (const auto& contour : text_outlines(words, 13, false))
        for (const Vec2d p : contour) {
            EXPECT_GT(p.x, -1.5);
            EXPECT_LT(p.x, sum + 1.5);
            EXPECT_GT(p.y, -13);
            EXPECT_LT(p.y, descender * 13 + 0.5);
        }
}

TEST(Svg, IsOneEscapedDocument) {
    Drawing drawing{.width = 100, .height = 50, .title = "a < b & \"c\"", .description = "d"};
    drawing.marks.push_back(Label{.at = {5, 20}, .text = "x<y>&\"z\""});
    drawing.marks.push_back(Path{.points = {{0.004, -0.001}, {99.996, 1.0 / 3}}, .ink = Ink::cone, .width = 1});
    drawing.marks.push_back(Dot{.centre = {10, 10}});
    const std::string text = svg_text(drawing, Paper::either);
    EXPECT_TRUE(text.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
    EXPECT_TRUE(text.ends_with("</svg>\n"));
    EXPECT_NE(text.find("<title>a &lt; b &amp; &quot;c&quot;</title>"), std::string::npos);
    EXPECT_NE(text.find(">x&lt;y&gt;&amp;&quot;z&quot;</text>"), std::string::npos);
    EXPECT_NE(text.find("points=\"0,0 100,0.33\""), std::string::npos) << text;
    EXPECT_NE(text.find("prefers-color-scheme:dark"), std::string::npos);
    EXPECT_EQ(svg_text(drawing, Paper::dark).find("prefers-color-scheme"), std::string::npos);
    EXPECT_EQ(text.find("s-secant"), std::string::npos) << "inks that nothing uses take no room";
    EXPECT_EQ(text, svg_text(drawing, Paper::either));
}

// WCAG 2.1: relative luminance, contrast; 4.5 for text, 3 for what carries meaning.
double luminance(Rgb8 c) {
    const auto linear = [](std::uint8_t v) {
        const double s = v / 255.0;
        return s <= 0.03928 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}
double contrast(Rgb8 a, Rgb8 b) {
    const double x = luminance(a), y = luminance(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(Ink, StandsOutOnEitherPaper) {
    const InkColour& paper = ink_colour(Ink::paper);
    for (int i = 0; i < ink_count; ++i) {
        const Ink ink = static_cast<Ink>(i);
        if (ink == Ink::paper || ink == Ink::grid || ink == Ink::ground) continue;
        const double least = ink == Ink::text || ink == Ink::muted ? 4.5 : 3.0;
        EXPECT_GE(contrast(ink_colour(ink).light, paper.light), least) << ink_colour(ink).id;
        EXPECT_GE(contrast(ink_colour(ink).dark, paper.dark), least) << ink_colour(ink).id;
        // Hits and steps are drawn over the ground too.
        if (ink == Ink::above || ink == Ink::below || ink == Ink::found || ink == Ink::truth || ink == Ink::surface) {
            EXPECT_GE(contrast(ink_colour(ink).light, ink_colour(Ink::ground).light), 2.4) << ink_colour(ink).id;
            EXPECT_GE(contrast(ink_colour(ink).dark, ink_colour(Ink::ground).dark), 2.4) << ink_colour(ink).id;
        }
    }
}

}  // namespace
}  // namespace relievo
