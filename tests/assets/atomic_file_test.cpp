#include "assets/atomic_file.h"

#include "core/error.h"
#include "temporary_folder.h"

namespace relievo::test {

using AtomicFileTest = InTemporaryFolder;

TEST_F(AtomicFileTest, AppearsWholeAndReplaces) {
    write_file_atomically(folder / "a.txt", "one");
    EXPECT_EQ(bytes_of(folder / "a.txt"), "one");
    write_file_atomically(folder / "a.txt", std::string_view("t\0o", 3));
    EXPECT_EQ(bytes_of(folder / "a.txt"), std::string("t\0o", 3));
    EXPECT_EQ(names(), std::vector<std::string>{"a.txt"});
}

TEST_F(AtomicFileTest, InterruptedWorkLeavesTheOldFileAndNothingElse) {
    put("a.txt", "old");
    EXPECT_THROW(
        {
            AtomicFile file(folder / "a.txt");
            std::ofstream(file.temporary()) << "half";
            EXPECT_EQ(names().size(), 2u);
            throw Cancelled();
        },
        Cancelled);
    EXPECT_EQ(names(), std::vector<std::string>{"a.txt"});
    EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
}

TEST_F(AtomicFileTest, TwoAtOnceDoNotMeet) {
    AtomicFile a(folder / "x");
    AtomicFile b(folder / "x");
    EXPECT_NE(a.temporary(), b.temporary());
}

TEST_F(AtomicFileTest, UnwritableTargetsAreErrorsBeforeTheWork) {
    put("plain", "");
    const auto target_of = [&](const std::filesystem::path& path) { return message_of<Error>([&] { AtomicFile file(path); }); };
    EXPECT_TRUE(has(target_of(folder / "missing" / "a.txt"), "No such file"));
    EXPECT_TRUE(has(target_of(folder / "plain" / "a.txt"), "Not a directory"));
    EXPECT_TRUE(has(target_of(folder), "names a folder"));
    EXPECT_TRUE(has(target_of(folder / ""), "names a folder"));
    EXPECT_TRUE(has(target_of("/dev/null"), "not a plain file"));
    if (::geteuid() != 0) {
        std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
        EXPECT_TRUE(has(target_of(folder / "a.txt"), "Permission denied"));
    }
}

}  // namespace relievo::test
