#include "board.hpp"

#include <jet/result.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace jet::host::check {

namespace {
constexpr std::size_t kField = 4096, kFields = 4;
}

Board::Board(const std::filesystem::path& file)
{
    const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    void* memory = MAP_FAILED;
    if (fd >= 0 && ::ftruncate(fd, kField * kFields) == 0)
        memory = ::mmap(nullptr, kField * kFields, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    const int code = errno;
    if (fd >= 0) ::close(fd);
    if (memory == MAP_FAILED)
        throw Failure(Error(std::string("cannot be written: ") + std::strerror(code), Location{file.string(), 0, 0}));
    memory_ = static_cast<char*>(memory);
}

Board::~Board() { ::munmap(memory_, kField * kFields); }

void Board::write(std::size_t field, std::string_view text)
{
    const std::size_t size = std::min(text.size(), kField - 1);
    char* at = memory_ + field * kField;
    std::memcpy(at, text.data(), size);
    at[size] = '\0';
}

std::string Board::read(std::size_t field) const { return {memory_ + field * kField}; }

}  // namespace jet::host::check
