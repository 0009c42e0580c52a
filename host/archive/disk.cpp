#include "disk.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace jet::host {

namespace fs = std::filesystem;

Error diskError(const fs::path& file, const std::string& what, int code)
{
    std::string remedy;
    if (code == EACCES || code == EPERM) remedy = "; check the permissions of the folder";
    if (code == EROFS) remedy = "; the file system is read-only: choose another place";
    if (code == ENOSPC || code == EDQUOT || code == EFBIG) remedy = "; free some space";
    if (code == ENOENT) remedy = "; check that the folder exists";
    return Error(what + ": " + std::strerror(code) + remedy, Location{file.string(), 0, 0});
}

Result<std::unique_ptr<NewFile>> NewFile::create(const fs::path& folder, const std::string& name, bool executable)
{
    const fs::path path = folder / name;
    std::error_code problem;
    fs::create_directories(path.parent_path(), problem);
    if (problem) return diskError(path.parent_path(), "the folder cannot be made", problem.value());
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, executable ? 0777 : 0666);
    if (fd < 0) return diskError(path, "cannot be written", errno);
    return std::unique_ptr<NewFile>(new NewFile(path, fd));
}

NewFile::~NewFile()
{
    if (fd_ >= 0) ::close(fd_);
}

Result<void> NewFile::write(std::string_view part)
{
    while (!part.empty()) {
        const ssize_t n = ::write(fd_, part.data(), part.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return diskError(path_, "cannot be written", errno);
        part.remove_prefix(static_cast<std::size_t>(n));
    }
    return {};
}

Result<void> NewFile::finish()
{
    if (fd_ < 0) return {};
    if (::fsync(fd_) != 0) return diskError(path_, "cannot be written", errno);
    const int closed = ::close(std::exchange(fd_, -1));
    if (closed != 0) return diskError(path_, "cannot be written", errno);
    return {};
}

Result<void> syncFolder(const fs::path& folder)
{
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return diskError(folder, "cannot be opened", errno);
    const int synced = ::fsync(fd);
    const int code = errno;
    ::close(fd);
    // Some file systems cannot sync a folder; there is nothing more to do about it.
    if (synced != 0 && code != EINVAL && code != EROFS) return diskError(folder, "cannot be written", code);
    return {};
}

Result<void> syncFolders(const fs::path& folder)
{
    std::error_code problem;
    for (fs::recursive_directory_iterator at(folder, problem), end; !problem && at != end; at.increment(problem))
        if (at->is_directory(problem))
            if (const auto synced = syncFolder(at->path()); !synced) return synced;
    if (problem) return diskError(folder, "cannot be read", problem.value());
    return syncFolder(folder);
}

Result<void> exchange(const fs::path& from, const fs::path& to)
{
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0) return {};
    if (errno != EINVAL && errno != ENOSYS) return diskError(to, "cannot be replaced", errno);
    // A file system that cannot exchange: two steps, the first taken back where the second fails.
    const fs::path aside = from.string() + ".aside";
    if (::rename(to.c_str(), aside.c_str()) != 0) return diskError(to, "cannot be replaced", errno);
    if (::rename(from.c_str(), to.c_str()) != 0) {
        const int code = errno;
        (void)::rename(aside.c_str(), to.c_str());
        return diskError(to, "cannot be replaced", code);
    }
    (void)::rename(aside.c_str(), from.c_str());
    return {};
}

Result<std::unique_ptr<FolderLock>> FolderLock::take(const fs::path& file)
{
    const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (fd < 0) return diskError(file.parent_path(), "cannot be written", errno);
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) return std::unique_ptr<FolderLock>(new FolderLock(fd));
    ::close(fd);
    return Error("another JET is installing plugins here; wait until it is done, then try again",
                 Location{file.parent_path().string(), 0, 0});
}

FolderLock::~FolderLock() { ::close(fd_); }

}  // namespace jet::host
