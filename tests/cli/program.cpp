#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace relievo::test {

namespace fs = std::filesystem;

namespace {

const Folder& scratch() {
    static const Folder folder;
    return folder;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const fs::path& folder) {
    static int count = 0;
    const std::string number = std::to_string(count++);
    out_ = scratch() / (number + ".out");
    err_ = scratch() / (number + ".err");

    std::vector<std::string> words{std::string(RELIEVO_BINARY_DIR) + "/bin/relievo"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string cache = scratch() / "cache";

    pid_ = ::fork();
    if (pid_ == 0) {
        const int null = ::open("/dev/null", O_RDONLY);
        const int out = ::open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        const int err = ::open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        ::dup2(null, 0);
        ::dup2(out, 1);
        ::dup2(err, 2);
        ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        if (!folder.empty() && ::chdir(folder.c_str()) != 0) ::_exit(126);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
}

Program::~Program() {
    if (pid_ <= 0 || ended_) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status_, 0);
}

bool Program::running() {
    if (ended_) return false;
    if (::waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
    return !ended_;
}

void Program::send(int signal) const { ::kill(pid_, signal); }

double Program::cpu_seconds() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    std::string line;
    std::getline(file, line);
    // Fields 14 and 15, counted from the state, which is the third and follows the name in brackets.
    const auto bracket = line.rfind(')');
    if (bracket == std::string::npos) return 0;
    std::istringstream fields(line.substr(bracket + 2));
    std::string skipped;
    for (int i = 3; i < 14; ++i) fields >> skipped;
    double user = 0, system = 0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

std::string Program::err() const { return read_text(err_); }

Ended Program::wait() {
    if (!ended_) ::waitpid(pid_, &status_, 0);
    ended_ = true;
    Ended ended;
    if (WIFEXITED(status_)) ended.code = WEXITSTATUS(status_);
    if (WIFSIGNALED(status_)) ended.signal = WTERMSIG(status_);
    ended.out = read_text(out_);
    ended.err = read_text(err_);
    return ended;
}

Ended run(const std::vector<std::string>& arguments, const fs::path& folder) { return Program(arguments, folder).wait(); }

bool has_device() {
    static const bool found = [] {
        const Ended list = run({"list", "devices", "--json"});
        const auto devices = nlohmann::json::parse(list.out, nullptr, false);
        return devices.is_array() && std::ranges::any_of(devices, [](const auto& d) { return d.value("lacks", "?").empty(); });
    }();
    return found;
}

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "relievo-cli-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::string read_text(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory()) files.push_back(fs::relative(entry.path(), folder).string());
    std::ranges::sort(files);
    return files;
}

}  // namespace relievo::test
