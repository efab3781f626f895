#include "tests/cli/run_command.h"

#include "tests/sequences/scratch_folder.h"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace gridreel::test {
namespace {

/// Where the command's stderr goes: a file or a terminal.
struct ErrorStream {
    int ours = -1;    ///< to read from, when a terminal
    int theirs = -1;  ///< the command's
};

ErrorStream open_errors(const Setting& setting, const std::filesystem::path& file) {
    ErrorStream stream;
    if (setting.terminal) {
        const winsize size{.ws_row = 25, .ws_col = 100, .ws_xpixel = 0, .ws_ypixel = 0};
        if (openpty(&stream.ours, &stream.theirs, nullptr, nullptr, &size) != 0) {
            throw std::runtime_error("no terminal");
        }
    } else {
        stream.theirs = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    }
    return stream;
}

std::string read_terminal(int terminal) {
    std::string text;
    char buffer[4096];
    while (true) {
        const ssize_t count = read(terminal, buffer, sizeof buffer);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return text;  // EIO: the other side is closed
        text.append(buffer, static_cast<std::size_t>(count));
    }
}

[[noreturn]] void become_gridreel(const std::vector<std::string>& arguments, const Setting& setting, int out,
                                  int err) {
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (chdir(setting.folder.c_str()) != 0) _exit(126);
    if (setting.most_memory > 0) {
        const rlimit limit{.rlim_cur = setting.most_memory, .rlim_max = setting.most_memory};
        if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(126);
    }
    // Whoever runs the tests may ignore Ctrl-C or want no colours.
    std::signal(SIGINT, SIG_DFL);
    unsetenv("NO_COLOR");
    setenv("TERM", "xterm", 1);
    for (const std::string& variable : setting.variables) putenv(const_cast<char*>(variable.c_str()));
    std::vector<char*> argv{const_cast<char*>("gridreel")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(GRIDREEL_COMMAND, argv.data());
    _exit(127);
}

}  // namespace

Outcome run_gridreel(const std::vector<std::string>& arguments, const Setting& setting) {
    const ScratchFolder scratch;
    const int out = open((setting.out_file.empty() ? scratch / "out" : setting.out_file).c_str(),
                         O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const ErrorStream err =
        open_errors(setting, setting.err_file.empty() ? scratch / "err" : setting.err_file);

    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("no process");
    if (process == 0) become_gridreel(arguments, setting, out, err.theirs);
    close(out);
    close(err.theirs);
    if (setting.meanwhile) setting.meanwhile(process);

    Outcome outcome;
    if (setting.terminal) outcome.err = read_terminal(err.ours);
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = bytes_of(scratch / "out");
    if (setting.terminal) {
        close(err.ours);
    } else {
        outcome.err = bytes_of(scratch / "err");
    }
    return outcome;
}

std::vector<nlohmann::json> read_log(const std::filesystem::path& file) {
    std::istringstream text(bytes_of(file));
    std::vector<nlohmann::json> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
}

std::vector<nlohmann::json> frames_of(const std::filesystem::path& file) {
    std::vector<nlohmann::json> frames = read_log(file);
    std::erase_if(frames, [](const nlohmann::json& line) { return line.at("schema") != "gridreel.frame/1"; });
    return frames;
}

}  // namespace gridreel::test
