#include "crash_signals.hpp"

#include "guard.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

namespace jet::host {

namespace {

constexpr std::array kCrashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS};
constexpr std::array kPolite{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};

const char* ledgerToRemove = nullptr;
std::array<struct sigaction, 65> before;  // by signal
std::terminate_handler terminateBefore = nullptr;

struct Place {
    const void* code = nullptr;
    const void* stack = nullptr;
};

Place placeOf(const void* context)
{
    [[maybe_unused]] const auto& registers = static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
    return {reinterpret_cast<const void*>(registers.gregs[REG_RIP]),
            reinterpret_cast<const void*>(registers.gregs[REG_RSP])};
#elif defined(__aarch64__)
    return {reinterpret_cast<const void*>(registers.pc), reinterpret_cast<const void*>(registers.sp)};
#else
    return {};
#endif
}

// Only what is allowed in a signal handler: stores, and system calls.
void onCrash(int signal, siginfo_t* info, void* context)
{
    BoardMemory& board = CallBoard::memory();
    std::int32_t none = 0;
    if (board.signal.compare_exchange_strong(none, signal)) {
        board.signalThread = static_cast<std::int32_t>(syscall(SYS_gettid));
        const Place place = placeOf(context);
        std::uint16_t owner = CallBoard::ownerOf(place.code);
        if (owner == 0 && place.stack) owner = CallBoard::ownerOnStack(place.stack);
        board.signalPlugin = owner;
    }
    sigaction(signal, &before[static_cast<std::size_t>(signal)], nullptr);
    // A fault happens again when the handler returns, and goes to whom it went before; a signal that was sent does not.
    if (info->si_code <= 0 || signal == SIGABRT) raise(signal);
}

void onPolite(int signal)
{
    CallBoard::memory().signal = signal;
    unlink(ledgerToRemove);
    sigaction(signal, &before[static_cast<std::size_t>(signal)], nullptr);
    raise(signal);
}

// So that a stack overflow can be noted, too.
void prepareStack()
{
    stack_t present{};
    if (sigaltstack(nullptr, &present) != 0 || !(present.ss_flags & SS_DISABLE)) return;
    alignas(16) static char memory[64 * 1024];
    stack_t own{};
    own.ss_sp = memory;
    own.ss_size = sizeof memory;
    sigaltstack(&own, nullptr);
}

// Nobody caught the exception, and its stack has not been unwound: a thread the plugin started itself. It alone ends,
// by the system call, since pthread_exit would unwind into the same terminate(); who joins it finds it ended.
[[noreturn]] void onTerminate()
{
    ThreadCalls* calls = CallBoard::hereIfAny();
    const bool called = calls && calls->depth > 0;
    const std::exception_ptr problem = std::current_exception();
    if (!called && problem && gettid() != getpid()) {
        const std::uint16_t owner = CallBoard::ownerOnStack(__builtin_frame_address(0));
        const bool known = CallAccount::with(owner, [&](Plugin& plugin, Guard& guard) {
            guard.fault(plugin, Callback::OwnCode, "a thread of its own failed: " + reasonOf(problem));
        });
        if (known && calls) calls->thread = 0;  // its destructor will not run
        while (known) syscall(SYS_exit, 0);
    }
    if (terminateBefore) terminateBefore();
    std::abort();
}

}  // namespace

bool isPolite(int signal) { return std::find(kPolite.begin(), kPolite.end(), signal) != kPolite.end(); }

void catchCrashes(const char* ledger)
{
    ledgerToRemove = ledger;
    prepareStack();
    for (const int signal : kCrashes) {
        struct sigaction action {};
        action.sa_sigaction = onCrash;
        action.sa_flags = SA_SIGINFO | SA_ONSTACK;
        sigemptyset(&action.sa_mask);
        sigaction(signal, &action, &before[static_cast<std::size_t>(signal)]);
    }
    for (const int signal : kPolite) {
        struct sigaction present {};
        if (sigaction(signal, nullptr, &present) != 0 || present.sa_handler != SIG_DFL) continue;
        before[static_cast<std::size_t>(signal)] = present;
        struct sigaction action {};
        action.sa_handler = onPolite;
        sigemptyset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
    terminateBefore = std::set_terminate(onTerminate);
}

}  // namespace jet::host
