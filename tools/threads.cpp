#include "tools/threads.h"

#include "sequences/thread_count.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace gridreel::tools {

void add_threads_option(CLI::App& app, int& threads) {
    app.add_option("-j,--threads", threads, "Threads")
        ->check(CLI::Range(1, 4096).description(""))
        ->type_name("N")
        ->default_str("all allowed")
        ->group("Machine");
}

int thread_count(int asked_for) {
    return asked_for > 0 ? asked_for : sequences::allowed_threads();
}

}  // namespace gridreel::tools
