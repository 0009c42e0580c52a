#include "runner.hpp"

#include "board.hpp"
#include "tests.hpp"

#include "host/plugins/plugin_manager.hpp"
#include "host/process/child_process.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace jet::host::check {

namespace fs = std::filesystem;

namespace {

std::string nameOf(const Test& test, const std::string& contribution)
{
    if (!test.kind) return std::string(test.name);
    std::string kind(kindName(*test.kind));
    std::replace(kind.begin(), kind.end(), ' ', '-');
    return kind + "-" + std::string(test.name) + ":" + contribution;
}

bool chosen(const std::vector<std::string>& only, const std::string& name)
{
    return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& one) {
               return name == one || name.starts_with(one + ":");
           });
}

Result<std::vector<fs::path>> pluginsIn(const fs::path& folder)
{
    std::error_code problem;
    const fs::path whole = fs::canonical(folder, problem);
    if (problem || !fs::is_directory(whole, problem))
        return Error("is no folder; name the folder of a built plugin, or one that holds some",
                     Location{folder.string(), 0, 0});
    if (fs::exists(whole / "plugin.json", problem)) return std::vector<fs::path>{whole};
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(whole, problem))
        if (fs::exists(entry.path() / "plugin.json", problem)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    if (found.empty())
        return Error("holds no built plugin: there is no plugin.json in it or one level below",
                     Location{folder.string(), 0, 0});
    return found;
}

void planPlugin(Plan& plan, const fs::path& folder, const std::vector<std::string>& only)
{
    PlannedPlugin plugin{folder, folder.filename().string(), {}};
    const auto manifest = Manifest::read(folder / "plugin.json");
    if (manifest) {
        plugin.manifest = *manifest;
        plugin.title = manifest->name + " (" + manifest->id + " " + manifest->version.text() + ")";
    }
    plan.plugins.push_back(std::move(plugin));
    const auto tests = allTests();
    for (std::size_t t = 0; t < tests.size(); ++t) {
        const auto add = [&](const std::string& contribution) {
            std::string name = nameOf(tests[t], contribution);
            if (chosen(only, name)) plan.tests.push_back({plan.plugins.size() - 1, t, contribution, std::move(name)});
        };
        if (!tests[t].kind && (manifest || tests[t].name == "manifest")) add("");
        if (!manifest || !tests[t].kind) continue;
        for (const Contribution& one : manifest->contributions)
            if (one.kind == *tests[t].kind) add(one.id);
    }
}

std::string quoted(const std::string& text)
{
    const bool plain =
        text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:+=@%") ==
        std::string::npos;
    if (plain && !text.empty()) return text;
    std::string all = "'";
    for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return all + "'";
}

std::string lineWith(const std::string& text, std::string_view mark)
{
    const std::size_t at = text.find(mark);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

/// What a sanitizer or the C++ runtime wrote before it ended the child.
std::string runtimeWords(const std::string& err)
{
    for (const char* mark :
         {"ERROR: AddressSanitizer", "runtime error: ", "ERROR: LeakSanitizer", "WARNING: ThreadSanitizer"})
        if (std::string line = lineWith(err, mark); !line.empty()) return line;
    if (std::string line = lineWith(err, "what():  "); !line.empty())
        return "an exception that nobody caught: " + line.substr(9);
    return {};
}

std::string lastLines(const std::string& text, int count)
{
    std::size_t at = text.size();
    while (at > 0 && text[at - 1] == '\n') --at;
    const std::size_t end = at;
    for (int n = 0; n < count && at > 0; ++n) {
        const std::size_t line = text.rfind('\n', at - 1);
        at = line == std::string::npos ? 0 : line;
    }
    return text.substr(at, end - at);
}

/// The reason a child failed; empty if it did not.
std::string reasonOf(const ChildOutcome& outcome, const Board& board, const ChildLimits& limits)
{
    const std::string words = runtimeWords(outcome.err);
    if (outcome.fine() && board.isDone()) return words;
    if (outcome.endedByItself() && !board.reason().empty()) return board.reason();
    std::string reason = outcome.reason(limits);
    if (board.isDone()) {
        reason += ", after the test, when its process ended";
    } else {
        if (outcome.endedByItself())
            reason = "it ended the whole program (exit code " + std::to_string(outcome.code) + ")";
        if (!board.callback().empty()) reason += " in " + board.callback();
        if (!board.activity().empty()) reason += " (" + board.activity() + ")";
    }
    return words.empty() ? reason : reason + ": " + words;
}

class Scratch {
public:
    Scratch()
    {
        std::string name = (fs::temp_directory_path() / "jet-check-XXXXXX").string();
        if (!::mkdtemp(name.data()))
            throw Failure(Error("no folder for the tests can be made; check TMPDIR", Location{name, 0, 0}));
        path_ = name;
    }
    ~Scratch()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

TestResult runTest(const PlannedPlugin& plugin, const PlannedTest& planned, const RunOptions& options)
{
    const Test& test = allTests()[planned.test];
    const Scratch scratch;
    const std::string seed = std::to_string(options.seed);
    std::vector<std::string> arguments{options.program.string(),
                                       "plugins",
                                       "check-one",
                                       plugin.folder.string(),
                                       planned.name,
                                       "--seed",
                                       seed,
                                       "--board",
                                       (scratch.path() / "board").string()};
    TestResult result;
    result.command =
        "jet plugins check " + quoted(plugin.folder.string()) + " --only " + quoted(planned.name) + " --seed " + seed;
    if (!options.samples.empty()) {
        const std::string samples = fs::absolute(options.samples).string();
        arguments.insert(arguments.end(), {"--samples", samples});
        result.command += " --samples " + quoted(samples);
    }
    ChildOptions child;
    child.folder = scratch.path();
    child.limits.time = std::chrono::seconds(test.seconds * kSlowness);
    child.limits.memory = static_cast<std::size_t>(test.megabytes * kSlowness) << 20;
    std::string path = plugin.folder.parent_path().string() + ":" + userPluginFolder().string();
    if (const char* own = std::getenv("JET_TEST_PLUGIN_PATH")) path = std::string(own) + ":" + path;
    // A library that was unloaded cannot be told from a leak; leaks are for the plugin's own tests.
    std::string asan = "detect_leaks=0";
    if (const char* own = std::getenv("ASAN_OPTIONS")) asan = std::string(own) + ":" + asan;
    child.environment = {{"JET_TEST_PLUGIN_PATH", path},
                         {"ASAN_OPTIONS", asan},
                         {"QT_QPA_PLATFORM", "offscreen"},
                         {"XDG_CONFIG_HOME", (scratch.path() / "config").string()},
                         {"XDG_CACHE_HOME", (scratch.path() / "cache").string()}};
    const Board board(scratch.path() / "board");
    const auto begin = std::chrono::steady_clock::now();
    const auto outcome = host::runChild(arguments, child);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.reason = outcome ? reasonOf(*outcome, board, child.limits) : outcome.error().message;
    if (result.reason.empty()) return result;
    result.kind = TestResult::Kind::Failed;
    if (outcome) result.output = lastLines(outcome->err, 12);
    return result;
}

/// Runs tests on several threads; tells results in the order of the plan.
class Run {
public:
    Run(const Plan& plan, const RunOptions& options,
        const std::function<void(const PlannedTest&, const TestResult&)>& told)
        : plan_(plan), options_(options), told_(told), results_(plan.tests.size()), ready_(plan.tests.size()),
          broken_(plan.plugins.size())
    {
    }

    std::vector<TestResult> all()
    {
        // Without these two the others would say the same once more.
        runWhere([&](std::size_t i) { return isBasic(plan_.tests[i]); });
        for (std::size_t i = 0; i < results_.size(); ++i) {
            const PlannedTest& test = plan_.tests[i];
            if (isBasic(test) && results_[i].kind == TestResult::Kind::Failed && broken_[test.plugin].empty())
                broken_[test.plugin] = test.name;
        }
        runWhere([&](std::size_t i) { return !isBasic(plan_.tests[i]); });
        return std::move(results_);
    }

private:
    static bool isBasic(const PlannedTest& test) { return test.name == "manifest" || test.name == "contributions"; }

    template <class Where>
    void runWhere(Where where)
    {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < plan_.tests.size(); i = next++)
                if (where(i)) finish(i, one(plan_.tests[i]));
        };
        const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
        const std::size_t count = options_.jobs > 0 ? static_cast<std::size_t>(options_.jobs) : processors;
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < std::min(count, plan_.tests.size()); ++i) threads.emplace_back(work);
        for (std::thread& thread : threads) thread.join();
    }

    TestResult one(const PlannedTest& test)
    {
        if (const std::string& failed = broken_[test.plugin]; !failed.empty())
            return {TestResult::Kind::Skipped, "not run, since '" + failed + "' failed", {}, {}, 0};
        try {
            return runTest(plan_.plugins[test.plugin], test, options_);
        } catch (const std::exception& e) {
            return {TestResult::Kind::Failed, e.what(), {}, {}, 0};
        }
    }

    void finish(std::size_t i, TestResult result)
    {
        const std::lock_guard lock(mutex_);
        results_[i] = std::move(result);
        ready_[i] = true;
        for (; toldCount_ < ready_.size() && ready_[toldCount_]; ++toldCount_)
            if (told_) told_(plan_.tests[toldCount_], results_[toldCount_]);
    }

    const Plan& plan_;
    const RunOptions& options_;
    const std::function<void(const PlannedTest&, const TestResult&)>& told_;
    std::mutex mutex_;  // guards what follows
    std::vector<TestResult> results_;
    std::vector<bool> ready_;
    std::vector<std::string> broken_;  // by plugin: the basic test that failed
    std::size_t toldCount_ = 0;
};

std::size_t threadCount()
{
    std::size_t count = 0;
    std::error_code ignored;
    for (const auto& task : fs::directory_iterator("/proc/self/task", ignored)) count += !task.path().empty();
    return count;
}

/// A thread that was joined may be seen a moment longer.
void checkThreads(std::size_t before)
{
    for (int i = 0; i < 50 && threadCount() > before; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const std::size_t now = threadCount();
    if (now > before)
        throw Failed("it leaves " + std::to_string(now - before) + (now - before == 1 ? " thread" : " threads") +
                     " running after its objects were destroyed");
}

}  // namespace

Result<Plan> planRun(const RunOptions& options)
{
    Plan plan;
    for (const fs::path& folder : options.folders) {
        const auto plugins = pluginsIn(folder);
        if (!plugins) return plugins.error();
        for (const fs::path& plugin : *plugins) planPlugin(plan, plugin, options.only);
    }
    if (plan.tests.empty()) return Error("no test has such a name; --list shows all");
    return plan;
}

std::vector<TestResult> runPlan(const Plan& plan, const RunOptions& options,
                                const std::function<void(const PlannedTest&, const TestResult&)>& told)
{
    RunOptions complete = options;
    if (complete.program.empty()) complete.program = ownProgram();
    return Run(plan, complete, told).all();
}

int runOne(const fs::path& folder, const std::string& name, std::uint64_t seed, const fs::path& samples,
           const fs::path& boardFile)
{
    Board board(boardFile);
    try {
        const std::size_t threads = threadCount();
        Plan plan;
        planPlugin(plan, folder, {name});
        if (plan.tests.size() != 1) throw Failed("there is no test '" + name + "'");
        Context context{folder,      plan.plugins[0].manifest, plan.tests[0].contribution, seed, samples, board,
                        Random(seed)};
        allTests()[plan.tests[0].test].run(context);
        board.activity("");
        checkThreads(threads);
        board.done();
        return 0;
    } catch (const std::exception& e) {
        board.reason(e.what());
        return 1;
    }
}

}  // namespace jet::host::check
