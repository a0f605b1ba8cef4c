// Ctrl-C at any moment: gone within two seconds, exit code 130, and nothing half-written.
#include "cli/materials.h"
#include "cli/program.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

namespace relievo::test {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Work of all threads after the signal. A second of two cores; on a machine that does other things too this says more than a clock.
constexpr double most_cpu_seconds = 2;
// A clock all the same, for a program that waits instead of working.
constexpr double most_seconds = 20;

// Waits until the program has used so much work (not time: the machine may be busy), then interrupts it. Returns how it ended.
Ended interrupt_after(Program& program, double cpu_seconds, int signal) {
    // Not before the program has said that it works: until then it is loading its libraries and ends as any program does.
    while (program.running() && (program.cpu_seconds() < cpu_seconds || program.err().empty())) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_TRUE(program.running()) << "the work was too short to be interrupted: " << program.err();
    const double before = program.cpu_seconds();
    double after = before;
    program.send(signal);
    const auto sent = Clock::now();
    while (program.running()) {
        after = std::max(after, program.cpu_seconds());
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    const Ended ended = program.wait();
    EXPECT_LT(after - before, most_cpu_seconds);
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - sent).count(), most_seconds);
    EXPECT_EQ(ended.code, 130) << "signal " << ended.signal << "\n" << ended.err;
    EXPECT_NE(ended.err.find("interrupted"), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "");
    return ended;
}

// Minutes of work in every stage: a large baking, a slow reference, many runs.
std::vector<std::string> long_comparison(const std::string& out, const std::string& texels) {
    return {"compare", "--material", "cobbles", "--texels", texels, "--size", "1280x720", "--runs", "500", "--no-cache", "--device", "software", "--out", out};
}

// Noise is the cone map's worst: no texel is far below its neighbours' cones.
void write_noise(const fs::path& file, int size) {
    ImageF noise(size, size, 1);
    std::mt19937 random(7);
    for (float& h : noise.texels) h = static_cast<float>(random() & 0xffff) / 65535.0f;
    write_png_16(file, noise, FirstRow::bottom);
}

}  // namespace

TEST(Interrupted, ComparisonLeavesNothing) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    // In loading, in baking, in the reference, in drawing.
    for (const double cpu : {0.3, 0.8, 2.0, 6.0}) {
        SCOPED_TRACE(cpu);
        Program program(long_comparison(folder / "report", "512"));
        interrupt_after(program, cpu, SIGINT);
        EXPECT_FALSE(fs::exists(folder / "report")) << "left: " << testing::PrintToString(files_below(folder / "report"));
    }
}

TEST(Interrupted, ComparisonLeavesAnOlderReportWhole) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const Ended made = run({"compare", "--material", "cobbles", "--texels", "32", "--size", "32x18", "--runs", "1", "--view", "grazing", "--technique",
                            "relief_mapping", "--device", "software", "--out", folder / "report"});
    ASSERT_EQ(made.code, 0) << made.err;
    const auto files = files_below(folder / "report");
    std::vector<std::string> before;
    for (const std::string& file : files) before.push_back(read_text(folder.path() / "report" / file));

    Program program({"compare", "--material", "cobbles", "--texels", "32", "--size", "320x180", "--runs", "2000", "--view", "grazing", "--view", "steep",
                     "--technique", "relief_mapping", "--device", "software", "--out", folder / "report"});
    interrupt_after(program, 3, SIGTERM);
    ASSERT_EQ(files_below(folder / "report"), files);
    for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(read_text(folder.path() / "report" / files[i]), before[i]) << files[i];
}

TEST(Interrupted, BakingLeavesNothing) {
    const Folder folder;
    write_noise(folder.path() / "noise.png", 1536);
    fs::create_directories(folder / "out");
    for (const double cpu : {0.1, 0.5}) {
        SCOPED_TRACE(cpu);
        Program program({"bake", "--height", folder / "noise.png", "--map", "cone", "--no-cache", "--out", folder / "out/cone.exr"});
        interrupt_after(program, cpu, SIGINT);
        EXPECT_TRUE(files_below(folder / "out").empty());
    }
}

TEST(Interrupted, BakingOnADeviceLeavesNothing) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    write_noise(folder.path() / "noise.png", 1536);
    fs::create_directories(folder / "out");
    for (const double cpu : {0.1, 0.9}) {
        SCOPED_TRACE(cpu);
        Program program({"bake", "--height", folder / "noise.png", "--map", "distance", "--device", "gpu", "--out", folder / "out/distance.exr"});
        interrupt_after(program, cpu, SIGINT);
        EXPECT_TRUE(files_below(folder / "out").empty());
    }
}

}  // namespace relievo::test
