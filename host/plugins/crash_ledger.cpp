#include "crash_ledger.hpp"

#include "call_board.hpp"
#include "crash_signals.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <memory>
#include <optional>
#include <sys/file.h>
#include <unistd.h>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLedger = ".ledger";  // of a running program, or of one that died
constexpr const char* kTold = ".told";      // of one that died, printed by a headless command

std::string bootId()
{
    std::ifstream file("/proc/sys/kernel/random/boot_id");
    std::string id;
    std::getline(file, id);
    return id;
}

std::string commandLine()
{
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    while (!text.empty() && text.back() == 0) text.pop_back();
    for (char& c : text)
        if (c == 0) c = ' ';
    return text;
}

template <std::size_t N>
void copyText(char (&target)[N], const std::string& text)
{
    const std::size_t length = std::min(text.size(), N - 1);
    std::memcpy(target, text.data(), length);
    target[length] = 0;
}

/// The name of this process's ledger, for what runs at the end.
char ledgerFile[4096];

// Runs after the static destructors of all plugins, which were loaded later.
void removeLedger()
{
    BoardMemory& board = CallBoard::memory();
    const ThreadCalls* calls = CallBoard::hereIfAny();
    if (calls && calls->depth > 0) {
        board.exitThread = static_cast<std::int32_t>(gettid());
        return;
    }
    unlink(ledgerFile);
}

}  // namespace

fs::path CrashLedger::defaultFolder()
{
    if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state) return fs::path(state) / "jet" / "ledger";
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".local" / "state" / "jet" / "ledger" : fs::path();
}

CrashLedger::CrashLedger(const fs::path& folder)
{
    std::error_code problem;
    if (folder.empty()) return;
    fs::create_directories(folder, problem);
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    const std::string name = std::to_string(getpid()) + "-" + std::to_string(now.tv_sec) + std::to_string(now.tv_nsec);
    const fs::path file = folder / (name + kLedger), fresh = folder / (name + ".new");
    if (file.string().size() >= sizeof ledgerFile) return;
    // Locked before it has its name: whoever finds an unlocked ledger knows that its program is gone.
    const int descriptor = open(fresh.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) return;
    BoardMemory& board = CallBoard::memory();
    board.startedAt = now.tv_sec;
    copyText(board.boot, bootId());
    copyText(board.command, commandLine());
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 || !CallBoard::moveTo(descriptor) ||
        std::rename(fresh.c_str(), file.c_str()) != 0) {
        unlink(fresh.c_str());
        return;  // the descriptor stays: the board may lie in it
    }
    std::strcpy(ledgerFile, file.c_str());
    std::atexit(removeLedger);
    catchCrashes(ledgerFile);
}

void CrashLedger::ending() { CallBoard::memory().ending = true; }

// --- reading

namespace {

std::string howItEnded(int signal)
{
    switch (signal) {
    case SIGSEGV: return "crashed (segmentation fault)";
    case SIGBUS: return "crashed (bus error)";
    case SIGFPE: return "crashed (arithmetic error)";
    case SIGILL: return "crashed (illegal instruction)";
    case SIGABRT: return "was aborted";
    default: return "ended with signal " + std::to_string(signal);
    }
}

struct Culprit {
    std::uint16_t plugin = 0;
    Callback callback = Callback::None;
    bool hung = false;
};

std::optional<Culprit> innermost(const ThreadCalls& calls)
{
    const std::uint32_t depth = std::min(calls.depth.load(), ThreadCalls::kDepth);
    if (depth == 0) return std::nullopt;
    const CallFrame& frame = calls.frames[depth - 1];
    return Culprit{frame.plugin, frame.callback, calls.told == frame.began};
}

// The calls of the thread that ended it; without a signal those of any, the first thread's before others.
std::optional<Culprit> findCulprit(const BoardMemory& board)
{
    std::int32_t guilty = board.exitThread;
    if (board.signal != 0) guilty = board.signalThread;
    for (const ThreadCalls& calls : board.threads)
        if (calls.thread != 0 && (guilty == 0 || calls.thread == guilty))
            if (const auto culprit = innermost(calls)) return culprit;
    if (board.signal != 0 && board.signalPlugin != 0) return Culprit{board.signalPlugin, Callback::OwnCode, false};
    return std::nullopt;
}

std::string describe(const BoardMemory& board, const Culprit& culprit, const std::string& title)
{
    char when[64] = "";
    const std::time_t started = board.startedAt;
    if (std::tm local{}; localtime_r(&started, &local)) std::strftime(when, sizeof when, "%Y-%m-%d %H:%M:%S", &local);
    std::string how = "was killed";
    if (board.exitThread != 0) how = "was ended by a call of exit()";
    if (board.signal != 0) how = howItEnded(board.signal);
    std::string where = "while the plugin " + title + " was in " + std::string(nameOf(culprit.callback));
    if (culprit.callback == Callback::OwnCode)
        where = board.ending ? "while the plugin " + title + " cleaned up at the end of the program"
                             : "in code of the plugin " + title + " that runs by itself (a thread or a timer)";
    if (culprit.hung) where += ", which had not returned for long";
    return "the run of JET that began at " + std::string(when) + " " + how + " " + where;
}

std::optional<CrashReport> readReport(const fs::path& file)
{
    const auto board = std::make_unique<BoardMemory>();
    std::ifstream in(file, std::ios::binary);
    in.read(reinterpret_cast<char*>(board.get()), sizeof *board);
    const bool whole =
        in.gcount() == sizeof *board && board->magic == BoardMemory::kMagic && board->layout == sizeof *board;
    board->boot[sizeof board->boot - 1] = 0;
    if (!whole || board->boot != bootId() || isPolite(board->signal)) return std::nullopt;
    const auto culprit = findCulprit(*board);
    if (!culprit || culprit->plugin == 0 || culprit->plugin >= BoardMemory::kPlugins) return std::nullopt;
    const std::string title(board->plugins[culprit->plugin],
                            strnlen(board->plugins[culprit->plugin], BoardMemory::kTitle));
    return CrashReport{title.substr(0, title.find(' ')),
                       title,
                       std::string(nameOf(culprit->callback)),
                       describe(*board, *culprit, title),
                       file.extension() == kTold,
                       file};
}

bool isAbandoned(const fs::path& file)
{
    const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) return false;
    const bool free = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    close(descriptor);
    return free;
}

}  // namespace

std::vector<CrashReport> CrashLedger::reports(const fs::path& folder)
{
    std::vector<CrashReport> all;
    std::error_code problem;
    if (folder.empty()) return all;
    for (const auto& entry : fs::directory_iterator(folder, problem)) {
        const fs::path& file = entry.path();
        const std::string extension = file.extension().string();
        if ((extension != kLedger && extension != kTold) || !isAbandoned(file)) continue;
        if (auto report = readReport(file)) {
            all.push_back(std::move(*report));
        } else {
            fs::remove(file, problem);
        }
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.message < b.message; });
    return all;
}

void CrashLedger::told(const CrashReport& report)
{
    std::error_code ignored;
    fs::path renamed = report.file;
    fs::rename(report.file, renamed.replace_extension(kTold), ignored);
}

void CrashLedger::settled(const CrashReport& report)
{
    std::error_code ignored;
    fs::remove(report.file, ignored);
}

}  // namespace jet::host
