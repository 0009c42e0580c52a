#include "check_commands.hpp"

#include "host/check/runner.hpp"
#include "host/check/tests.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

using check::Plan;
using check::PlannedTest;
using check::TestResult;

struct CheckCommand {
    check::RunOptions run;
    bool list = false;
    fs::path folder, board;  // of the hidden command
    std::string test;
};

const char* word(TestResult::Kind kind)
{
    return kind == TestResult::Kind::Passed ? "ok" : kind == TestResult::Kind::Failed ? "FAIL" : "skip";
}

/// The readable report, test by test.
class Report {
public:
    Report(const Plan& plan, bool quiet) : plan_(plan), quiet_(quiet)
    {
        for (const PlannedTest& test : plan.tests) width_ = std::max(width_, test.name.size());
    }

    void tell(const PlannedTest& test, const TestResult& result)
    {
        if (quiet_) return;
        if (test.plugin != plugin_) std::printf("%s\n", plan_.plugins[plugin_ = test.plugin].title.c_str());
        std::printf("  %-4s  %-*s  %5.2f s\n", word(result.kind), static_cast<int>(width_), test.name.c_str(),
                    result.seconds);
        if (result.kind == TestResult::Kind::Passed) return std::fflush(stdout), void();
        std::printf("        %s\n", result.reason.c_str());
        if (!result.output.empty()) printIndented(result.output);
        if (!result.command.empty()) std::printf("        again: %s\n", result.command.c_str());
        std::fflush(stdout);
    }

private:
    static void printIndented(const std::string& text)
    {
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            if (end > at) std::printf("        | %s\n", text.substr(at, end - at).c_str());
            at = end + 1;
        }
    }

    const Plan& plan_;
    bool quiet_;
    std::size_t width_ = 0;
    std::size_t plugin_ = ~std::size_t{0};
};

Json jsonOf(const Plan& plan, const std::vector<TestResult>& results, std::uint64_t seed)
{
    Json json{{"ok", true}, {"seed", seed}, {"passed", 0}, {"failed", 0}, {"skipped", 0}, {"plugins", Json::array()}};
    for (const auto& plugin : plan.plugins)
        json["plugins"].push_back({{"id", plugin.manifest.id},
                                   {"version", plugin.manifest.version.text()},
                                   {"folder", plugin.folder.string()},
                                   {"tests", Json::array()}});
    int counts[3] = {};
    for (std::size_t i = 0; i < results.size(); ++i) {
        const TestResult& result = results[i];
        ++counts[static_cast<int>(result.kind)];
        Json test{{"name", plan.tests[i].name}, {"result", word(result.kind)}, {"seconds", result.seconds}};
        if (result.kind != TestResult::Kind::Passed) {
            test["reason"] = result.reason;
            test["output"] = result.output;
            test["command"] = result.command;
        }
        json["plugins"][plan.tests[i].plugin]["tests"].push_back(std::move(test));
    }
    json["passed"] = counts[0], json["failed"] = counts[1], json["skipped"] = counts[2];
    json["ok"] = counts[1] == 0;
    return json;
}

int listTests(Session& session)
{
    Json list = Json::array();
    for (const check::Test& test : check::allTests()) {
        std::string kind(test.kind ? kindName(*test.kind) : "");
        std::replace(kind.begin(), kind.end(), ' ', '-');
        const std::string name = test.kind ? kind + "-" + std::string(test.name) : std::string(test.name);
        list.push_back({{"name", name}, {"what", test.what}});
        if (!session.options().json) std::printf("%-30s %s\n", name.c_str(), std::string(test.what).c_str());
    }
    if (session.options().json) std::printf("%s\n", list.dump(2).c_str());
    return kOk;
}

int runChecks(Session& session, const CheckCommand& command)
{
    if (command.list) return listTests(session);
    if (command.run.folders.empty()) {
        session.error(Error("name the folder of a built plugin, or one that holds some"));
        return kUsage;
    }
    const auto plan = check::planRun(command.run);
    if (!plan) {
        session.error(plan.error());
        return kUsage;
    }
    const bool json = session.options().json;
    Report report(*plan, json);
    const auto begin = std::chrono::steady_clock::now();
    const auto results = check::runPlan(
        *plan, command.run, [&](const PlannedTest& test, const TestResult& result) { report.tell(test, result); });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Json summary = jsonOf(*plan, results, command.run.seed);
    if (json) {
        std::printf("%s\n", summary.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    } else {
        std::printf("%zu plugins, %d tests passed, %d failed, %d not run, seed %llu, %.1f s\n", plan->plugins.size(),
                    summary["passed"].get<int>(), summary["failed"].get<int>(), summary["skipped"].get<int>(),
                    static_cast<unsigned long long>(command.run.seed), seconds);
    }
    return summary["ok"].get<bool>() ? kOk : kFailed;
}

}  // namespace

void addCheckCommands(CLI::App& plugins, std::function<int(Session&)>& run)
{
    const auto command = std::make_shared<CheckCommand>();
    auto* checking =
        plugins.add_subcommand("check", "Run the conformance tests on built plugins, each in a process of its own");
    checking->add_option("folders", command->run.folders, "Folders of built plugins, or folders that hold some")
        ->type_name("DIR");
    checking->add_option("--only", command->run.only, "Run this test only: its name, with or without :ID; may repeat")
        ->type_name("TEST")
        ->take_all()
        ->allow_extra_args(false);
    checking->add_option("--seed", command->run.seed, "Seed of all that is random")
        ->type_name("N")
        ->capture_default_str();
    checking->add_option("--samples", command->run.samples, "Folder of sample files for importers, by extension")
        ->type_name("DIR");
    checking->add_option("--jobs", command->run.jobs, "Tests at a time; one a processor if not given")
        ->check(CLI::Range(1, 256));
    checking->add_flag("--list", command->list, "Print the names of all tests");
    checking->callback([&run, command] { run = [command](Session& s) { return runChecks(s, *command); }; });

    // The child of the above: one test.
    auto* one = plugins.add_subcommand("check-one", "")->group("");
    one->add_option("folder", command->folder)->required();
    one->add_option("test", command->test)->required();
    one->add_option("--seed", command->run.seed);
    one->add_option("--samples", command->run.samples);
    one->add_option("--board", command->board)->required();
    one->callback([&run, command] {
        run = [command](Session&) {
            return check::runOne(command->folder, command->test, command->run.seed, command->run.samples,
                                 command->board);
        };
    });
}

}  // namespace jet::host
