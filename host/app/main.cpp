#include "editor.hpp"

#include "host/cli/commands.hpp"

#include <cstdio>
#include <exception>

int main(int argc, char** argv)
{
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
