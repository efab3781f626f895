#include "tools/console.h"

#include "sequences/errors.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace gridreel::tools {
namespace {

constexpr std::string_view clear_line = "\r\x1b[K";

bool color_wanted(When when) {
    if (when != When::automatic) return when == When::always;
    const char* no_color = std::getenv("NO_COLOR");
    const char* terminal = std::getenv("TERM");
    return Console::on_terminal() && !(no_color && *no_color) && terminal &&
           std::string_view(terminal) != "dumb";
}

/// Names in files are anyone's: what would steer the terminal is spelled out.
/// @param kept  control characters that may stay
std::string printable(std::string_view text, std::string_view kept) {
    std::string safe;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        const bool steers = code < 0x20 || code == 0x7f;
        if (steers && kept.find(c) == kept.npos)
            safe += fmt::format("\\x{:02x}", code);
        else
            safe += c;
    }
    return safe;
}

/// Writes to stderr, best effort: there is nowhere left to report that it failed.
void say(std::string_view text) noexcept {
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
    (void)std::fflush(stderr);
}

}  // namespace

Console::Console(const ConsoleOptions& options) : options_(options), color_(color_wanted(options.color)) {}

bool Console::on_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

std::size_t Console::columns() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

void Console::message(std::string_view kind, std::string_view color, std::string_view text) {
    if (bar_shown_) say(clear_line);
    bar_shown_ = false;
    const std::string safe = printable(text, "");
    say(color_ ? fmt::format("gridreel: \x1b[{}m{}:\x1b[0m {}\n", color, kind, safe)
               : fmt::format("gridreel: {}: {}\n", kind, safe));
}

void Console::error(std::string_view text) {
    message("error", "31", text);
}

void Console::warning(std::string_view text) {
    if (!options_.quiet) message("warning", "33", text);
}

void Console::note(std::string_view text) {
    if (!options_.quiet) message("note", "36", text);
}

void Console::detail(std::string_view text) {
    if (options_.verbose && !options_.quiet) message("detail", "2", text);
}

void Console::result(std::string_view text) {
    if (options_.quiet) return;
    errno = 0;
    const std::string safe = printable(text, "\n");
    const bool taken = std::fwrite(safe.data(), 1, safe.size(), stdout) == safe.size();
    if (taken && std::fflush(stdout) == 0) return;
    throw sequences::OutputError(fmt::format("cannot write ({})", std::generic_category().message(errno)),
                                 "stdout", "check where the output goes and the free space there");
}

void Console::line(std::string_view text) {
    if (!options_.quiet) say(printable(text, "") + '\n');
}

void Console::bar(std::string_view text) {
    if (options_.quiet) return;
    say(fmt::format("{}{}", clear_line, printable(text, "")));
    bar_shown_ = true;
}

void Console::end_bar() {
    if (bar_shown_) say("\n");
    bar_shown_ = false;
}

void ProgressDisplay::started(const sequences::JobStart& start) {
    console_.note(fmt::format("{}; {} frame{} of {}x{} pixels", start.clip, start.frames,
                              start.frames == 1 ? "" : "s", start.width, start.height));
    progress_.total = start.frames;
    start_ = std::chrono::steady_clock::now();
}

void ProgressDisplay::frame_done(const sequences::FrameRecord& record) {
    ++progress_.done;
    progress_.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const bool as_bar = when_ == When::always || (when_ == When::automatic && Console::on_terminal());
    if (record.failed()) {
        if (report_failures_) console_.error(fmt::format("frame {}: {}", record.frame, record.error));
    } else if (when_ != When::never && !as_bar) {
        console_.line(sequences::progress_line(progress_, record));
    }
    // A cell is left free: writing into the last column makes some terminals wrap.
    if (as_bar) console_.bar(sequences::progress_bar(progress_, record, Console::columns() - 1));
}

}  // namespace gridreel::tools
