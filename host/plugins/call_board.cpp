#include "call_board.hpp"

#include <algorithm>
#include <cstring>
#include <fcntl.h>
#include <link.h>
#include <mutex>
#include <new>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

namespace jet::host {

namespace {

constexpr std::size_t kBytes = sizeof(BoardMemory);

std::mutex& registering()
{
    static std::mutex mutex;  // guards adding plugins and ranges
    return mutex;
}

std::int32_t threadId() { return static_cast<std::int32_t>(gettid()); }

}  // namespace

BoardMemory* const CallBoard::memory_ = CallBoard::create();

BoardMemory* CallBoard::create()
{
    void* pages = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    // Fresh pages are zero, which is what most of it starts with: only the pages that differ are touched.
    auto* board = static_cast<BoardMemory*>(pages);
    board->magic = BoardMemory::kMagic;
    board->layout = kBytes;
    board->pluginCount = 1;
    return board;
}

ThreadCalls& CallBoard::join()
{
    // Gives the place back when the thread ends.
    struct Leaver {
        ThreadCalls* calls = nullptr;
        ~Leaver()
        {
            if (calls && calls->depth > 0) return;  // exit() inside a call: that is worth knowing
            here_ = nullptr;
            if (calls) calls->thread = 0;
        }
    };
    thread_local Leaver leaver;
    thread_local ThreadCalls unnoted;  // more threads than places: guarded all the same
    here_ = &unnoted;
    for (ThreadCalls& place : memory_->threads) {
        std::int32_t free = 0;
        if (!place.thread.compare_exchange_strong(free, threadId())) continue;
        place.depth = 0;
        place.told = 0;
        place.alive = 0;
        leaver.calls = here_ = &place;
        break;
    }
    return *here_;
}

std::uint16_t CallBoard::addPlugin(std::string_view title)
{
    const std::lock_guard lock(registering());
    const std::uint32_t index = memory_->pluginCount;
    if (index >= BoardMemory::kPlugins) return 0;
    char* place = memory_->plugins[index];
    const std::size_t length = std::min(title.size(), BoardMemory::kTitle - 1);
    std::memcpy(place, title.data(), length);
    place[length] = 0;
    memory_->pluginCount = index + 1;
    return static_cast<std::uint16_t>(index);
}

namespace {

struct Search {
    std::uintptr_t wanted;
    std::uintptr_t begin = 0, end = 0;
};

// Finds the whole extent of the library an address lies in.
int findLibrary(dl_phdr_info* library, std::size_t, void* data)
{
    auto& search = *static_cast<Search*>(data);
    std::uintptr_t begin = ~std::uintptr_t{0}, end = 0;
    for (int i = 0; i < library->dlpi_phnum; ++i) {
        const auto& segment = library->dlpi_phdr[i];
        if (segment.p_type != PT_LOAD) continue;
        begin = std::min(begin, library->dlpi_addr + segment.p_vaddr);
        end = std::max(end, library->dlpi_addr + segment.p_vaddr + segment.p_memsz);
    }
    if (search.wanted < begin || search.wanted >= end) return 0;
    search.begin = begin;
    search.end = end;
    return 1;
}

}  // namespace

void CallBoard::addCode(std::uint16_t plugin, const void* anyAddress)
{
    Search search{reinterpret_cast<std::uintptr_t>(anyAddress)};
    if (plugin == 0 || dl_iterate_phdr(findLibrary, &search) == 0) return;
    const std::lock_guard lock(registering());
    const std::uint32_t index = memory_->rangeCount;
    if (index >= BoardMemory::kRanges) return;
    CodeRange& range = memory_->ranges[index];
    range.begin = search.begin;
    range.end = search.end;
    range.plugin = plugin;
    memory_->rangeCount = index + 1;
}

namespace {

int releaseLibrary(dl_phdr_info* library, std::size_t, void* data)
{
    const auto wanted = *static_cast<const std::uintptr_t*>(data);
    bool here = false;
    for (int pass = 0; pass < 2; ++pass)
        for (int i = 0; i < library->dlpi_phnum; ++i) {
            const auto& segment = library->dlpi_phdr[i];
            if (segment.p_type != PT_LOAD) continue;
            const std::uintptr_t begin = library->dlpi_addr + segment.p_vaddr;
            here = here || (wanted >= begin && wanted < begin + segment.p_memsz);
            constexpr std::uintptr_t kPage = 4096;
            const std::uintptr_t first = begin & ~(kPage - 1);
            if (pass == 1 && here && !(segment.p_flags & PF_W))
                madvise(reinterpret_cast<void*>(first), begin + segment.p_filesz - first, MADV_DONTNEED);
        }
    return here ? 1 : 0;
}

}  // namespace

void CallBoard::releaseCode(const void* anyAddress)
{
    auto address = reinterpret_cast<std::uintptr_t>(anyAddress);
    dl_iterate_phdr(releaseLibrary, &address);
}

void CallBoard::removeCode(std::uint16_t plugin)
{
    for (std::uint32_t i = 0, n = memory_->rangeCount; i < n; ++i) {
        CodeRange& range = memory_->ranges[i];
        if (range.plugin == plugin) range.plugin = 0, range.begin = 0, range.end = 0;
    }
}

std::uint16_t CallBoard::ownerOf(const void* code)
{
    const auto address = reinterpret_cast<std::uintptr_t>(code);
    // The latest first: where a library was really unloaded, another may lie at its place.
    for (std::uint32_t i = memory_->rangeCount; i-- > 0;) {
        const CodeRange& range = memory_->ranges[i];
        if (address >= range.begin && address < range.end) return range.plugin;
    }
    return 0;
}

std::uint16_t CallBoard::ownerOnStack(const void* from, std::uint16_t only)
{
    // Read through the kernel: an address beyond the stack is an error there, not a crash.
    constexpr std::size_t kWords = 512, kBlocks = 16;
    static thread_local std::uintptr_t words[kWords];
    auto address = reinterpret_cast<std::uintptr_t>(from) & ~(sizeof(void*) - 1);
    for (std::size_t block = 0; block < kBlocks; ++block, address += sizeof words) {
        iovec mine{words, sizeof words}, stack{reinterpret_cast<void*>(address), sizeof words};
        const ssize_t got = process_vm_readv(getpid(), &mine, 1, &stack, 1, 0);
        for (std::size_t i = 0; got > 0 && i < static_cast<std::size_t>(got) / sizeof(void*); ++i)
            if (const auto owner = ownerOf(reinterpret_cast<const void*>(words[i]));
                owner != 0 && (only == 0 || owner == only))
                return owner;
        if (got < static_cast<ssize_t>(sizeof words)) break;
    }
    return 0;
}

bool CallBoard::moveTo(int file)
{
    // Reserved, not only long: a hole that cannot be filled on a full disk would be a SIGBUS in the middle of a call.
    if (posix_fallocate(file, 0, static_cast<off_t>(kBytes)) != 0) return false;
    const std::lock_guard lock(registering());
    const auto* bytes = reinterpret_cast<const char*>(memory_);
    constexpr std::size_t kPage = 4096;
    static constexpr char kZero[kPage] = {};
    for (std::size_t at = 0; at < kBytes; at += kPage) {
        const std::size_t count = std::min(kPage, kBytes - at);
        if (std::memcmp(bytes + at, kZero, count) == 0) continue;
        if (pwrite(file, bytes + at, count, static_cast<off_t>(at)) != static_cast<ssize_t>(count)) return false;
    }
    return mmap(memory_, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, file, 0) != MAP_FAILED;
}

}  // namespace jet::host
