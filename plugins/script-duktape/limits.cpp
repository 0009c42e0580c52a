#include "limits.hpp"

#include "play.hpp"

#include <duktape.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <new>

namespace jet::duktape {

namespace {

// One unit is about one property access (20-50 ns): the clock is read every 20 us or so.
constexpr int kFuel = 500;
// Enough for an error object with its traceback, and soon used up by a script that caught the error.
constexpr int kFuelForError = 20'000;
// Beyond the memory limit, for the error object.
constexpr std::size_t kReserve = 64U << 10;

// Scripts are charged for the processor time of their thread: a busy computer must not stop an innocent script.
std::chrono::nanoseconds processorTime()
{
#if defined(CLOCK_THREAD_CPUTIME_ID) && !defined(__EMSCRIPTEN__)
    timespec t{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) == 0)
        return std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec);
#endif
    return std::chrono::steady_clock::now().time_since_epoch();
}

// Before each block; as large as the strictest alignment, so that the block keeps it.
union Header {
    std::size_t size;
    std::max_align_t align;
};

Header* headerOf(void* block) { return static_cast<Header*>(block) - 1; }

}  // namespace

Budget::Budget(const Limits& limits) : limits_(limits), memoryLimit_(limits.memory)
{
    data_.fuel = kFuel;
    data_.budget = this;
}

void Budget::begin(std::chrono::nanoseconds time)
{
    deadline_ = std::chrono::steady_clock::now() + time;
    time_ = time;
    processorTimeKnown_ = false;
    stackStart_ = static_cast<const char*>(__builtin_frame_address(0));
    outOfMemory_ = false;
    running_ = true;
    timedOut_ = false;
    data_.fuel = kFuel;
}

bool Budget::mustStop()
{
    data_.fuel = kFuel;
    if (!running_) return false;
    if (!timedOut_ && !outOfMemory_) {
        // Processor time costs a system call, so it is first read some way into a long call and then at the deadline.
        if (!processorTimeKnown_) processorTimeAtStart_ = processorTime(), processorTimeKnown_ = true;
        const auto now = std::chrono::steady_clock::now();
        if (now < deadline_) return false;
        const std::chrono::nanoseconds used = processorTime() - processorTimeAtStart_;
        if (used < time_) {
            deadline_ = now + (time_ - used);
            return false;
        }
        timedOut_ = true;
    }
    data_.fuel = kFuelForError;
    return true;
}

bool Budget::stackIsLow() const
{
    const char* here = static_cast<const char*>(__builtin_frame_address(0));
    return running_ && stackStart_ > here && static_cast<std::size_t>(stackStart_ - here) > limits_.stack;
}

bool Budget::reserve(std::size_t bytes)
{
    const std::size_t limit = memoryLimit_ + (outOfMemory_ ? kReserve : 0);
    if (bytes > limit || used_ > limit - bytes) return false;
    used_ += bytes;
    return true;
}

void* Budget::allocate(std::size_t size)
{
    if (size == 0 || !reserve(size + sizeof(Header))) return nullptr;
    auto* header = static_cast<Header*>(std::malloc(size + sizeof(Header)));
    if (!header) {
        used_ -= size + sizeof(Header);
        return nullptr;
    }
    header->size = size;
    return header + 1;
}

void* Budget::reallocate(void* block, std::size_t size)
{
    if (!block) return allocate(size);
    if (size == 0) {
        release(block);
        return nullptr;
    }
    const std::size_t before = headerOf(block)->size;
    if (size > before && !reserve(size - before)) return nullptr;
    auto* header = static_cast<Header*>(std::realloc(headerOf(block), size + sizeof(Header)));
    if (!header) {
        if (size > before) used_ -= size - before;
        return nullptr;
    }
    if (size < before) used_ -= before - size;
    header->size = size;
    return header + 1;
}

void Budget::release(void* block)
{
    if (!block) return;
    used_ -= headerOf(block)->size + sizeof(Header);
    std::free(headerOf(block));
}

void Budget::growMemoryLimit() { memoryLimit_ = std::min(memoryLimit_ + limits_.memory / 8, 2 * limits_.memory); }

}  // namespace jet::duktape

using jet::duktape::Budget;
using jet::duktape::HeapData;

extern "C" int jet_script_timed_out(void* udata) { return Budget::of(udata).mustStop() ? 1 : 0; }

extern "C" void jet_script_out_of_memory(void* udata) { Budget::of(udata).memoryIsOut(); }

extern "C" int jet_script_stack_is_low(void* udata) { return Budget::of(udata).stackIsLow() ? 1 : 0; }

extern "C" void jet_script_checkpoint(duk_hthread* thr)
{
    duk_memory_functions functions;
    duk_get_memory_functions(thr, &functions);
    if (Budget::of(functions.udata).mustStop()) (void)duk_error(thr, DUK_ERR_RANGE_ERROR, "stopped");
}

extern "C" double jet_script_now_ms(duk_hthread* thr)
{
    duk_memory_functions functions;
    duk_get_memory_functions(thr, &functions);
    const auto* play = static_cast<HeapData*>(functions.udata)->play;
    return play ? play->milliseconds() : 0;
}

extern "C" double jet_script_random(void* udata)
{
    auto* play = static_cast<HeapData*>(udata)->play;
    return play ? play->simulation.random() : 0.5;
}
