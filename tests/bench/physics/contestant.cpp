#include "bench/physics/contestant.hpp"

#include "bench/physics/quality.hpp"
#include "bench/physics/quality_soft.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace jet::bench {

namespace {

constexpr int kStretch = 30;       // steps a turn: the first one or two meet cold caches, the median does not
constexpr int kPatience = 60'000;  // ms an engine may take for its turn
constexpr char kMore = 'm', kDone = 'd', kProblem = 'p';

double milliseconds(clockid_t clock)
{
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

std::size_t heapInUse()
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

double part(std::vector<double> values, std::size_t percent)
{
    std::sort(values.begin(), values.end());
    return values[values.size() * percent / 100];
}

/// The run of one engine, in stretches. Within the contestant's process.
class Run {
public:
    Run(const Scene& scene, const Contestant::Make& make)
        : scene_(scene), heap_(heapInUse()), engine_(make()), watch_(scene)
    {
        times_.reserve(static_cast<std::size_t>(scene.steps)), walls_.reserve(static_cast<std::size_t>(scene.steps));
        for (int i = 0; i < scene.warmUpSteps; ++i) {
            engine_->step(scene.dt);
            refuseWhatIsNoNumber("of warming up", i + 1);
        }
        before_ = posesOf(*engine_, scene.bodies.size());
    }

    bool done() const { return static_cast<int>(times_.size()) == scene_.steps; }
    void stretch()
    {
        for (int i = 0; i < kStretch && !done(); ++i) step();
    }
    nlohmann::ordered_json summary() const
    {
        const std::size_t heap = heapInUse();
        const std::vector<Pose> now = posesOf(*engine_, scene_.bodies.size());
        nlohmann::ordered_json quality = qualityOf(scene_, before_, now);
        if (!scene_.soft.empty()) quality.update(watch_.quality(now));
        return {{"median", part(times_, 50)},  {"p95", part(times_, 95)},
                {"wall", part(walls_, 50)},    {"undisturbed", part(walls_, 10)},
                {"memory", engine_->memory()}, {"heap", heap - std::min(heap, heap_)},
                {"quality", quality}};
    }

private:
    void step()
    {
        if (static_cast<int>(times_.size()) == scene_.steps - 1) before_ = posesOf(*engine_, scene_.bodies.size());
        const double start = milliseconds(CLOCK_THREAD_CPUTIME_ID), wall = milliseconds(CLOCK_MONOTONIC);
        engine_->step(scene_.dt);
        times_.push_back(milliseconds(CLOCK_THREAD_CPUTIME_ID) - start);
        walls_.push_back(milliseconds(CLOCK_MONOTONIC) - wall);
        refuseWhatIsNoNumber("that were timed", static_cast<int>(times_.size()));
        watch_.see(*engine_);
    }
    /// Nothing that comes after is worth its time, and some engines never come back from it.
    void refuseWhatIsNoNumber(const char* phase, int step) const
    {
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            const Pose pose = engine_->pose(i);
            const Point& start = scene_.bodies[i].position;
            const double far = std::abs(pose.position.x - start.x) + std::abs(pose.position.y - start.y);
            if (!(far < 2000) || !std::isfinite(pose.angle))
                throw std::runtime_error("it explodes: body " + std::to_string(i) + " is " + std::to_string(far) +
                                         " m away after " + std::to_string(step) + " steps " + phase);
        }
    }

    const Scene& scene_;
    std::size_t heap_;
    std::unique_ptr<Engine> engine_;
    SoftWatch watch_;
    std::vector<double> times_, walls_;
    std::vector<Pose> before_;
};

void sendAll(int file, char kind, const std::string& text)
{
    const std::uint64_t size = text.size();
    std::string message(1, kind);
    message.append(reinterpret_cast<const char*>(&size), sizeof size).append(text);
    for (std::size_t sent = 0; sent < message.size();) {
        const ssize_t count = write(file, message.data() + sent, message.size() - sent);
        if (count <= 0) _exit(1);  // nobody listens any more
        sent += static_cast<std::size_t>(count);
    }
}

/// False at the end of the file, or when nothing came in time.
bool readAll(int file, char* into, std::size_t size, bool& late)
{
    for (std::size_t got = 0; got < size;) {
        pollfd ready{file, POLLIN, 0};
        late = poll(&ready, 1, kPatience) == 0;
        if (late) return false;
        const ssize_t count = read(file, into + got, size - got);
        if (count <= 0) return false;
        got += static_cast<std::size_t>(count);
    }
    return true;
}

std::string lastLine(int file)
{
    char text[2048];
    const off_t size = lseek(file, 0, SEEK_END);
    const ssize_t count = pread(file, text, sizeof text, std::max<off_t>(0, size - static_cast<off_t>(sizeof text)));
    std::string all(text, count > 0 ? static_cast<std::size_t>(count) : 0);
    while (!all.empty() && std::isspace(static_cast<unsigned char>(all.back())) != 0) all.pop_back();
    return all.substr(all.rfind('\n') + 1);
}

}  // namespace

Contestant::Contestant(const Scene& scene, Make make)
{
    int commands[2], answers[2];
    if (pipe2(commands, O_CLOEXEC) != 0 || pipe2(answers, O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "There is no pipe for an engine's process");
    noise_ = memfd_create("noise", MFD_CLOEXEC);
    std::fflush(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "There is no process for an engine");
    if (process_ == 0) {
        close(commands[1]), close(answers[0]);
        serve(scene, make, commands[0], answers[1]);
    }
    close(commands[0]), close(answers[1]);
    commands_ = commands[1], answers_ = answers[0];
}

Contestant::~Contestant()
{
    close(commands_), close(answers_), close(noise_);
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

void Contestant::serve(const Scene& scene, const Make& make, int commands, int answers)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody else ends an engine that does not come back
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    dup2(noise_, STDERR_FILENO), dup2(noise_, STDOUT_FILENO);
    std::optional<Run> run;
    try {
        for (char command = 0; read(commands, &command, 1) == 1;) {
            if (!run) run.emplace(scene, make);
            run->stretch();
            sendAll(answers, run->done() ? kDone : kMore, run->done() ? run->summary().dump() : "");
        }
    } catch (const std::exception& problem) {
        sendAll(answers, kProblem, problem.what());
    }
    _exit(0);
}

bool Contestant::stretch()
{
    ++turns_;
    // Who died before its turn is found by the answer that does not come.
    std::signal(SIGPIPE, SIG_IGN);
    const char command = kMore;
    [[maybe_unused]] const ssize_t sent = write(commands_, &command, 1);
    return receive();
}

bool Contestant::receive()
{
    char kind = 0;
    std::uint64_t size = 0;
    bool late = false;
    std::string text;
    bool complete = readAll(answers_, &kind, 1, late) && readAll(answers_, reinterpret_cast<char*>(&size), 8, late);
    if (complete) {
        text.resize(size);
        complete = readAll(answers_, text.data(), size, late);
    }
    if (!complete) {
        fail(late ? "took more than a minute" : "");
    } else if (kind == kProblem) {
        problem_ = text;
    } else if (kind == kDone) {
        const auto json = nlohmann::ordered_json::parse(text);
        result_ = {json.at("median"), json.at("p95"),  json.at("wall"),   json.at("undisturbed"),
                   json.at("memory"), json.at("heap"), json.at("quality")};
    }
    return complete && kind == kMore;
}

void Contestant::fail(const std::string& happened)
{
    problem_ = happened;
    if (happened.empty()) {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = -1;
        problem_ = WIFSIGNALED(status) ? "ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                                             strsignal(WTERMSIG(status)) + ")"
                                       : "ended early";
    }
    const int first = (turns_ - 1) * kStretch;
    problem_ += turns_ == 1
                    ? " at the start or in the first " + std::to_string(kStretch) + " timed steps"
                    : " within " + std::to_string(kStretch) + " steps after timed step " + std::to_string(first);
    const std::string said = lastLine(noise_);
    if (!said.empty()) problem_ += ": " + said;
}

}  // namespace jet::bench
