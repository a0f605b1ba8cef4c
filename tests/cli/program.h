// The built program as a user meets it: arguments in; exit code, texts and files out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace relievo::test {

// How a run ended.
struct Ended {
    int code = -1;       // exit code; -1 when a signal ended it
    int signal = 0;      // the signal, 0 when it exited
    std::string out;     // standard output
    std::string err;     // standard error
};

// A started program. Its cache is a folder of this test process, never the user's own.
class Program {
public:
    // folder: where it runs; empty: here.
    explicit Program(const std::vector<std::string>& arguments, const std::filesystem::path& folder = {});
    ~Program();  // kills and collects what still runs
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    bool running();
    void send(int signal) const;
    double cpu_seconds() const;  // used so far, over all threads; 0 once it ended
    std::string err() const;     // standard error so far
    Ended wait();

private:
    int pid_ = -1;
    int status_ = 0;
    bool ended_ = false;
    std::filesystem::path out_, err_;
};

// Starts, waits and returns.
Ended run(const std::vector<std::string>& arguments, const std::filesystem::path& folder = {});

// False where this machine has no Vulkan device: what draws is skipped there.
bool has_device();

// A folder for a test's files, removed with it.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

// Every file below a folder by its relative path, sorted; temporary files of any run are among them.
std::vector<std::string> files_below(const std::filesystem::path& folder);

}  // namespace relievo::test
