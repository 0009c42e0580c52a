#include "child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace jet::host {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

// A sanitizer reserves terabytes of addresses, so there the resident size alone is watched.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitAddresses = false;
#else
constexpr bool kLimitAddresses = true;
#endif

class Pipe {
public:
    Pipe() { open_ = ::pipe2(ends_.data(), O_CLOEXEC) == 0; }
    ~Pipe()
    {
        closeRead();
        closeWrite();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    bool isOpen() const { return open_; }
    int read() const { return ends_[0]; }
    int write() const { return ends_[1]; }
    void closeRead() { close(0); }
    void closeWrite() { close(1); }

private:
    void close(std::size_t end)
    {
        if (ends_[end] >= 0) ::close(ends_[end]);
        ends_[end] = -1;
    }
    std::array<int, 2> ends_{-1, -1};
    bool open_ = false;
};

std::vector<std::string> environmentOf(const ChildOptions& options)
{
    std::vector<std::string> list;
    for (char** entry = environ; *entry; ++entry) {
        const std::string_view text(*entry);
        bool replaced = false;
        for (const auto& [name, value] : options.environment)
            replaced |= text.starts_with(name) && text.size() > name.size() && text[name.size()] == '=';
        if (!replaced) list.emplace_back(text);
    }
    for (const auto& [name, value] : options.environment) list.push_back(name + "=" + value);
    return list;
}

std::vector<char*> pointers(std::vector<std::string>& texts)
{
    std::vector<char*> list;
    list.reserve(texts.size() + 1);
    for (std::string& text : texts) list.push_back(text.data());
    list.push_back(nullptr);
    return list;
}

// Between fork and exec: calls that are safe there only.
[[noreturn]] void become(const char* program, char** arguments, char** environment, const char* folder, int out,
                         int err, std::size_t memory, pid_t parent)
{
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);  // it died before that took effect
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    const rlimit noCore{0, 0};
    ::setrlimit(RLIMIT_CORE, &noCore);
    if (memory > 0 && kLimitAddresses) {
        const rlimit limit{memory, memory};
        ::setrlimit(RLIMIT_AS, &limit);
    }
    if (*folder && ::chdir(folder) != 0) ::_exit(127);
    ::execve(program, arguments, environment);
    ::_exit(127);
}

std::size_t residentBytes(pid_t pid)
{
    std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
    std::size_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Reads what the child writes until it has ended, and sees to its limits.
class Watch {
public:
    Watch(pid_t pid, const ChildLimits& limits, Pipe& out, Pipe& err)
        : pid_(pid), limits_(limits), out_(out), err_(err), end_(Clock::now() + limits.time)
    {
    }

    ChildOutcome run()
    {
        int status = 0;
        for (bool ended = false; !ended;) {
            readSome();
            ended = ::waitpid(pid_, &status, WNOHANG) == pid_;
            if (!ended) check();
        }
        drain();
        ::kill(-pid_, SIGKILL);  // what it started and left behind
        const bool ours = outcome_.timedOut || outcome_.tooMuchMemory || outcome_.tooMuchOutput;
        if (WIFSIGNALED(status) && !ours) outcome_.signal = WTERMSIG(status);
        if (WIFEXITED(status)) outcome_.code = WEXITSTATUS(status);
        return std::move(outcome_);
    }

private:
    void readSome()
    {
        std::array<pollfd, 2> waiting{pollfd{out_.read(), POLLIN, 0}, pollfd{err_.read(), POLLIN, 0}};
        (void)::poll(waiting.data(), waiting.size(), 10);
        if (waiting[0].revents != 0) readFrom(out_, outcome_.out, limits_.output, true);
        if (waiting[1].revents != 0) readFrom(err_, outcome_.err, limits_.errors, false);
    }

    // False at the end or when there is nothing more now.
    bool readFrom(Pipe& pipe, std::string& into, std::size_t most, bool strict)
    {
        std::array<char, 1 << 16> buffer;
        const ssize_t n = ::read(pipe.read(), buffer.data(), buffer.size());
        if (n < 0) return errno == EINTR;
        if (n == 0) {
            pipe.closeRead();
            return false;
        }
        const auto count = static_cast<std::size_t>(n);
        if (into.size() + count > most && strict) outcome_.tooMuchOutput = true;
        into.append(buffer.data(), std::min(count, most - into.size()));
        return true;
    }

    void drain()
    {
        for (Pipe* pipe : {&out_, &err_})
            if (pipe->read() >= 0) ::fcntl(pipe->read(), F_SETFL, O_NONBLOCK);
        while (out_.read() >= 0 && readFrom(out_, outcome_.out, limits_.output, true)) continue;
        while (err_.read() >= 0 && readFrom(err_, outcome_.err, limits_.errors, false)) continue;
    }

    void check()
    {
        if (Clock::now() >= end_) outcome_.timedOut = true;
        if (limits_.memory > 0 && residentBytes(pid_) > limits_.memory) outcome_.tooMuchMemory = true;
        if (outcome_.timedOut || outcome_.tooMuchMemory || outcome_.tooMuchOutput) ::kill(-pid_, SIGKILL);
    }

    pid_t pid_;
    const ChildLimits& limits_;
    Pipe& out_;
    Pipe& err_;
    Clock::time_point end_;
    ChildOutcome outcome_;
};

std::string secondsText(std::chrono::milliseconds time)
{
    const auto tenths = time.count() / 100;
    return std::to_string(tenths / 10) + (tenths % 10 ? "." + std::to_string(tenths % 10) : "") + " s";
}

}  // namespace

std::string ChildOutcome::reason(const ChildLimits& limits) const
{
    if (timedOut) return "it did not end within " + secondsText(limits.time);
    if (tooMuchMemory) return "it needed more than " + std::to_string(limits.memory >> 20) + " MB of memory";
    if (tooMuchOutput) return "it wrote more than " + std::to_string(limits.output >> 10) + " kB";
    if (signal != 0) return "it crashed (signal " + std::to_string(signal) + ", " + ::strsignal(signal) + ")";
    return "it ended with exit code " + std::to_string(code);
}

Result<ChildOutcome> runChild(const std::vector<std::string>& arguments, const ChildOptions& options)
{
    const std::string& name = arguments.at(0);
    const fs::path program = name.find('/') != std::string::npos ? fs::path(name) : findProgram(name);
    if (program.empty() || ::access(program.c_str(), X_OK) != 0)
        return Error("the program '" + name + "' is not installed; install it");
    std::vector<std::string> words = arguments, variables = environmentOf(options);
    const std::vector<char*> argv = pointers(words), envp = pointers(variables);
    Pipe out, err;
    if (!out.isOpen() || !err.isOpen())
        return Error("the program '" + name + "' cannot be started: " + std::strerror(errno) +
                     "; close other programs");
    const std::string folder = options.folder.string();
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid < 0)
        return Error("the program '" + name + "' cannot be started: " + std::strerror(errno) +
                     "; close other programs");
    if (pid == 0)
        become(program.c_str(), const_cast<char**>(argv.data()), const_cast<char**>(envp.data()), folder.c_str(),
               out.write(), err.write(), options.limits.memory, parent);
    ::setpgid(pid, pid);  // in both, so that it holds whoever runs first
    out.closeWrite();
    err.closeWrite();
    return Watch(pid, options.limits, out, err).run();
}

fs::path findProgram(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::string_view rest = path ? path : "/usr/bin:/bin";
    while (!rest.empty()) {
        const std::size_t colon = rest.find(':');
        const fs::path candidate = fs::path(rest.substr(0, colon)) / name;
        std::error_code ignored;
        if (candidate.is_absolute() && fs::is_regular_file(candidate, ignored) &&
            ::access(candidate.c_str(), X_OK) == 0)
            return candidate;
        rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
    }
    return {};
}

fs::path ownProgram()
{
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored);
}

}  // namespace jet::host
