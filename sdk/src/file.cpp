#include "system_error.hpp"

#include <jet/format.hpp>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace jet {

namespace fs = std::filesystem;

Error systemError(const fs::path& file, const std::string& what, int code)
{
    std::string remedy;
    if (code == EACCES || code == EPERM) remedy = "; check the permissions of the file and its folder";
    if (code == EROFS) remedy = "; the file system is read-only: choose another place";
    if (code == ENOSPC || code == EDQUOT || code == EFBIG) remedy = "; free some space or choose another place";
    if (code == ENOENT) remedy = "; check the name and that its folder exists";
    if (code == ESTALE || code == EIO) remedy = "; the disk or the network folder fails: save to another place";
    return Error(what + ": " + std::strerror(code) + remedy, Location{file.string(), 0, 0});
}

namespace {

class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor()
    {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }
    int close() { return ::close(std::exchange(fd_, -1)); }

private:
    int fd_;
};

constexpr std::size_t kLargestFile = 0xffffffffU;  // places in it are kept in 32 bits

bool writeAll(int fd, std::span<const std::byte> content)
{
    while (!content.empty()) {
        const ssize_t n = ::write(fd, content.data(), content.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        content = content.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

// A device or a pipe (/dev/stdout) has no old content to keep, and renaming a file over it would destroy it.
Result<void> writeInto(const fs::path& file, std::span<const std::byte> content)
{
    Descriptor out(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
    if (out.get() < 0) return systemError(file, "cannot be written", errno);
    if (!writeAll(out.get(), content)) return systemError(file, "cannot be written", errno);
    if (out.close() != 0) return systemError(file, "cannot be written", errno);
    return {};
}

}  // namespace

Result<void> syncFolder(const fs::path& folder)
{
    const Descriptor directory(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory.get() < 0 && (errno == EACCES || errno == EPERM)) return {};  // one may write to it but not read it
    if (directory.get() < 0) return systemError(folder, "was written, but may not outlive a power cut", errno);
    if (::fsync(directory.get()) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS) return {};
    return systemError(folder, "was written, but may not outlive a power cut", errno);
}

std::string extensionOf(const fs::path& file)
{
    std::string extension = file.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

Result<std::string> readFile(const fs::path& file)
{
    const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (in.get() < 0) return systemError(file, "cannot be opened", errno);
    struct stat info {};
    if (::fstat(in.get(), &info) != 0) return systemError(file, "cannot be read", errno);
    if (S_ISDIR(info.st_mode))
        return Error("is a folder, not a file; name a file in it", Location{file.string(), 0, 0});
    std::string content;
    content.reserve(static_cast<std::size_t>(std::max<off_t>(info.st_size, 0)) + 1);
    char buffer[1 << 16];
    for (;;) {
        const ssize_t n = ::read(in.get(), buffer, sizeof buffer);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return systemError(file, "cannot be read", errno);
        if (n == 0) return content;
        if (content.size() > kLargestFile)
            return Error("is larger than 4 GB; this is no file for JET", Location{file.string(), 0, 0});
        content.append(buffer, static_cast<std::size_t>(n));
    }
}

Result<void> writeFileAtomically(const fs::path& file, std::span<const std::byte> content)
{
    std::error_code ignored;
    const fs::path target = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file, ignored) : file;
    if (fs::is_directory(target, ignored))
        return Error("is a folder; name a file to write", Location{file.string(), 0, 0});
    struct stat old {};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (exists && !S_ISREG(old.st_mode)) return writeInto(file, content);
    // A read-only target is a wish to keep it: rename() alone would replace it.
    if (exists && ::access(target.c_str(), W_OK) != 0) return systemError(file, "cannot be written", errno);
    if (exists && (old.st_mode & 0222) == 0) return systemError(file, "cannot be written", EACCES);
    const mode_t mode = exists ? old.st_mode & 07777 : 0666;

    const fs::path temporary =
        target.parent_path() / ("." + target.filename().string() + "." + std::to_string(::getpid()) + ".part");
    Descriptor out(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode));
    if (out.get() < 0) return systemError(file, "cannot be written", errno);
    const auto giveUp = [&](int code) {
        ::unlink(temporary.c_str());
        return systemError(file, "cannot be written", code);
    };
    if (!writeAll(out.get(), content) || ::fsync(out.get()) != 0) return giveUp(errno);
    if (exists) (void)!::fchmod(out.get(), mode);
    if (out.close() != 0) return giveUp(errno);
    if (::rename(temporary.c_str(), target.c_str()) != 0) return giveUp(errno);
    return syncFolder(target.parent_path());  // the new name survives a power cut
}

Result<void> writeFileAtomically(const fs::path& file, std::string_view content)
{
    return writeFileAtomically(file, std::as_bytes(std::span(content.data(), content.size())));
}

}  // namespace jet
