#pragma once
// What people see on the terminal: messages, progress, results.

#include "sequences/job_observer.h"
#include "sequences/progress.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace gridreel::tools {

enum class When { automatic, always, never };

/// Options that every command has.
struct ConsoleOptions {
    bool quiet = false;  ///< errors only
    bool verbose = false;
    When color = When::automatic;
};

/// Messages go to stderr, results to stdout, without control characters but for the ends of a result's lines.
/// A message that cannot be written is dropped.
class Console {
public:
    explicit Console(const ConsoleOptions& options);

    void error(std::string_view text);
    void warning(std::string_view text);  ///< not when quiet
    void note(std::string_view text);     ///< not when quiet
    void detail(std::string_view text);   ///< only when verbose

    /// On stdout; not when quiet.
    /// @throws sequences::OutputError when it cannot be written
    void result(std::string_view text);

    /// A line of progress, on stderr; not when quiet.
    void line(std::string_view text);

    /// Replaces the progress bar, the last line of the terminal.
    void bar(std::string_view text);

    /// Leaves the bar as it stands and goes to the next line.
    void end_bar();

    [[nodiscard]] static bool on_terminal();
    [[nodiscard]] static std::size_t columns();  ///< of the terminal, 80 when unknown

private:
    void message(std::string_view kind, std::string_view color, std::string_view text);

    ConsoleOptions options_;
    bool color_ = false;
    bool bar_shown_ = false;
};

/// Shows a job's progress: a bar on a terminal, else one line per frame.
class ProgressDisplay : public sequences::JobObserver {
public:
    /// @param report_failures  of frames; false where whoever runs the job reports them
    ProgressDisplay(Console& console, When when, bool report_failures)
        : console_(console), when_(when), report_failures_(report_failures) {}

    void started(const sequences::JobStart& start) override;
    void warning(std::string_view text) override { console_.warning(text); }
    void note(std::string_view text) override { console_.note(text); }
    void frame_done(const sequences::FrameRecord& record) override;

    [[nodiscard]] const sequences::Progress& progress() const { return progress_; }

private:
    Console& console_;
    When when_;
    bool report_failures_;
    sequences::Progress progress_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace gridreel::tools
