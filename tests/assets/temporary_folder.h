// A folder of its own for each test, removed with everything in it.
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace relievo::test {

class InTemporaryFolder : public ::testing::Test {
protected:
    InTemporaryFolder() {
        std::string name = ::testing::TempDir() + "relievo-assets-XXXXXX";
        if (!::mkdtemp(name.data())) std::abort();
        folder = name;
    }
    ~InTemporaryFolder() override {
        std::error_code ignored;
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all, ignored);
        std::filesystem::remove_all(folder, ignored);
    }

    std::filesystem::path put(const std::string& name, std::string_view bytes) const {
        std::filesystem::create_directories((folder / name).parent_path());
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }
    std::string bytes_of(const std::filesystem::path& file) const {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::vector<std::string> names() const {
        std::vector<std::string> list;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) list.push_back(entry.path().filename().string());
        std::sort(list.begin(), list.end());
        return list;
    }

    std::filesystem::path folder;
};

// The message of the exception of type E that `work` throws.
template <class E, class F>
std::string message_of(F&& work) {
    try {
        work();
    } catch (const E& e) {
        return e.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

inline bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace relievo::test
