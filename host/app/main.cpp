#include "editor.hpp"

#include "host/cli/commands.hpp"

#include <csignal>
#include <cstdio>
#include <exception>

int main(int argc, char** argv)
{
    // A file that may not grow further (RLIMIT_FSIZE) is a failed write with a message, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        jet::host::GlobalOptions global;
        std::filesystem::path project;
        if (const auto code = jet::host::runCommandLine(argc, argv, global, project)) return *code;
        return jet::host::runEditor(argc, argv, global, project);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        return jet::host::kFailed;
    }
}
